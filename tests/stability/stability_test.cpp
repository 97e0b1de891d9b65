// Every known failure: the naive method shows it, ours does not.
#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <sstream>

#include "accuracy/failures/failure_case.h"

namespace sdf::accuracy {

void PrintTo(const FailureCase& c, std::ostream* out) { *out << c.name; }

namespace stability_test {

class Failure : public testing::TestWithParam<FailureCase> {};

std::string testName(const testing::TestParamInfo<FailureCase>& info) {
  std::string name;
  bool start = true;
  for (const unsigned char c : info.param.name) {
    if (std::isalnum(c)) name += start ? static_cast<char>(std::toupper(c)) : static_cast<char>(c);
    start = !std::isalnum(c);
  }
  return name;
}

TEST_P(Failure, IsRealForTheNaiveMethodAndHeldByOurs) {
  const FailureCase& c = GetParam();
  const Figures figures = c.run();
  EXPECT_TRUE(c.isReal(figures)) << c.naive.what << ": " << figures.naive << " " << c.figure << "; "
                                 << c.reason;
  EXPECT_TRUE(c.isHeld(figures)) << c.ours.what << ": " << figures.ours << " " << c.figure << "; "
                                 << c.reason;
}

INSTANTIATE_TEST_SUITE_P(Known, Failure, testing::ValuesIn(failureCases()), testName);

TEST(Report, HasARowForEveryFailure) {
  std::ostringstream page;
  page << std::ifstream(SDF_SOURCE_DIR "/docs/accuracy.md").rdbuf();
  for (const FailureCase& c : failureCases())
    EXPECT_NE(page.str().find("\n| " + c.name + " |"), std::string::npos)
        << c.name << " is missing: run accuracy docs/accuracy.md";
}

}  // namespace stability_test
}  // namespace sdf::accuracy
