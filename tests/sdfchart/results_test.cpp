// results.csv keeps what was measured, whatever interrupts it.
#include "sdfchart/results.h"

#include <gtest/gtest.h>

#include "sdfchart/measure.h"
#include "support/folder.h"

namespace sdf::chart {
namespace {

Row row(const std::string& method) { return {.kind = "meshing", .scene = "ball", .method = method}; }

TEST(Results, AreThereAgainWhenTheFileIsOpened) {
  const Folder folder;
  const auto file = folder / "results.csv";
  {
    Results results = take(Results::open(file, "sdfchart 1"));
    Row first = row("a, \"quoted\"");
    first.seconds = 0.5;
    ASSERT_TRUE(results.append(first));
  }
  Results again = take(Results::open(file, "sdfchart 1"));
  EXPECT_TRUE(again.has(row("a, \"quoted\"")));
  EXPECT_FALSE(again.has(row("b")));
  ASSERT_TRUE(again.append(row("b")));
  EXPECT_EQ(take(Results::open(file, "sdfchart 1")).size(), 2u);
}

TEST(Results, DropTheHalfLineOfAnInterruptedRun) {
  const Folder folder;
  const auto file = folder / "results.csv";
  ASSERT_TRUE(take(Results::open(file, "sdfchart 1")).append(row("a")));
  const std::string whole = contents(file);
  std::ofstream(file, std::ios::app) << "meshing,ball,b,16 vox";
  Results again = take(Results::open(file, "sdfchart 1"));
  EXPECT_EQ(contents(file), whole);
  EXPECT_EQ(again.size(), 1u);
}

TEST(Results, OfOtherOptionsAreNotMixed) {
  const Folder folder;
  const auto file = folder / "results.csv";
  ASSERT_TRUE(take(Results::open(file, "sdfchart 1 --quick")).append(row("a")));
  const Result<Results> other = Results::open(file, "sdfchart 1");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().kind, ErrorKind::Usage);
  EXPECT_NE(other.error().message.find("--quick"), std::string::npos) << other.error().message;
}

TEST(Results, AFileOfAnotherKindIsLeftAlone) {
  const Folder folder;
  const auto file = folder / "results.csv";
  std::ofstream(file) << "my own,figures\n1,2\n";
  const Result<Results> opened = Results::open(file, "sdfchart 1");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().kind, ErrorKind::Files);
  EXPECT_EQ(contents(file), "my own,figures\n1,2\n");
}

TEST(Quantiles, LieBetweenTheValues) {
  EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(quantile({1.0, 2.0}, 0.25), 1.25);
  EXPECT_EQ(quantile({7.0}, 0.75), 7.0);
}

TEST(Batches, AFailingMeasurementIsARowThatSaysWhy) {
  const Folder folder;
  Results results = take(Results::open(folder / "results.csv", "sdfchart 1"));
  RunProgress progress(false, false);
  const Batch batch{.make = [] {
    return std::vector<Measurement>{
        {row("good"), [](Row*) { return 0.25; }},
        {row("bad"), [](Row*) -> double { throw std::runtime_error("no slope"); }}};
  }};
  ASSERT_TRUE(runBatches({batch}, results, "a machine", progress));
  const std::string text = contents(folder / "results.csv");
  EXPECT_NE(text.find("good,,,0,0.25,0.25,0.25,5"), std::string::npos) << text;
  EXPECT_NE(text.find("failed: no slope,a machine"), std::string::npos) << text;
}

TEST(Batches, WhatIsThereIsNotMeasuredAgain) {
  const Folder folder;
  int ran = 0;
  RunProgress progress(false, false);
  const Batch batch{.runs = 1, .make = [&] {
                      return std::vector<Measurement>{{row("a"), [&](Row*) { return ++ran; }}};
                    }};
  for (int i = 0; i < 2; ++i) {
    Results results = take(Results::open(folder / "results.csv", "sdfchart 1"));
    ASSERT_TRUE(runBatches({batch}, results, "", progress));
  }
  EXPECT_EQ(ran, 1);
}

}  // namespace
}  // namespace sdf::chart
