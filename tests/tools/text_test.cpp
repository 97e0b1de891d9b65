#include "command_line/text.h"

#include <gtest/gtest.h>

namespace sdf {
namespace text_test {

using command_line::formatted, command_line::grouped;

TEST(Text, IsPrintfs) {
  EXPECT_EQ(formatted("%.2f of %d", 0.125, 3), "0.12 of 3");
  EXPECT_EQ(formatted("nothing"), "nothing");
  EXPECT_EQ(formatted("%s", std::string(300, 'a').c_str()), std::string(255, 'a')) << "cut off";
}

TEST(Text, GroupsThousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(12'345'678), "12,345,678");
}

}  // namespace text_test
}  // namespace sdf
