// results.csv keeps what was measured, whatever interrupts it.
#include "sdfchart/results.h"

#include <gtest/gtest.h>

#include "sdfchart/measure/measure.h"
#include "support/folder.h"

namespace sdf::chart {
namespace results_test {

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

TEST(Results, HavePicturesBesideThem) {
  const Folder folder;
  const auto file = folder / "results.csv", pictures = folder / "pictures.csv";
  Row lit = row("soft");
  lit.picture = "00fefeff", lit.truePicture = "0000feff", lit.pictureSide = 2;
  ASSERT_TRUE(take(Results::open(file, "sdfchart 1")).append(row("without")));
  EXPECT_FALSE(std::filesystem::exists(pictures));
  ASSERT_TRUE(take(Results::open(file, "sdfchart 1")).append(lit));
  EXPECT_EQ(contents(pictures), "meshing,ball,soft,,2,00fefeff,0000feff\n");
  std::filesystem::remove(file);
  ASSERT_TRUE(Results::open(file, "sdfchart 1"));
  EXPECT_FALSE(std::filesystem::exists(pictures)) << "they are of rows that are gone";
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

TEST(Batches, SlowOnesAreRepeatedLessThanFastOnes) {
  const Folder folder;
  RunProgress progress(false, false);
  Results results = take(Results::open(folder / "results.csv", "sdfchart 1"));
  const auto runs = [&](bool together, const std::string& mark) {
    const Batch batch{.runs = 4, .budget = 3.0, .together = together, .make = [mark] {
                        return std::vector<Measurement>{{row("fast" + mark), [](Row*) { return 0.01; }},
                                                        {row("slow" + mark), [](Row*) { return 1.0; }},
                                                        {row("last" + mark), [](Row*) { return 0.5; }}};
                      }};
    EXPECT_TRUE(runBatches({batch}, results, "", progress));
  };
  runs(false, " alone");
  runs(true, " together");
  const std::string text = contents(folder / "results.csv");
  for (const char* words :
       {"fast alone,,,0,0.01,0.01,0.01,4", "slow alone,,,0,1,1,1,1", "last alone,,,0,0.5,0.5,0.5,2",
        "fast together,,,0,0.01,0.01,0.01,2", "slow together,,,0,1,1,1,2"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " is not in\n" << text;
  EXPECT_LT(text.find("fast alone"), text.find("slow alone"));
  EXPECT_LT(text.find("slow alone"), text.find("last alone"));
}

// What ended before the program is told to end is kept.
TEST(Batches, RowsAreWrittenBeforeTheirBatchEnds) {
  const Folder folder;
  RunProgress progress(false, false);
  Results results = take(Results::open(folder / "results.csv", "sdfchart 1"));
  std::string seen;
  int ran = 0;
  const Batch batch{.runs = 2, .budget = 2.0, .make = [&] {
                      return std::vector<Measurement>{{row("slow"), [](Row*) { return 5.0; }},
                                                      {row("fast"), [&](Row*) {
                                                         if (++ran == 2)
                                                           seen = contents(folder / "results.csv");
                                                         return 0.1;
                                                       }}};
                    }};
  ASSERT_TRUE(runBatches({batch}, results, "", progress));
  EXPECT_NE(seen.find("slow,,,0,5"), std::string::npos) << seen;
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

}  // namespace results_test
}  // namespace sdf::chart
