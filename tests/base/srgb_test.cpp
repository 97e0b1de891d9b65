#include "sdf/base/srgb.h"

#include <gtest/gtest.h>

namespace sdf {
namespace srgb_test {

TEST(Srgb, ItsPiecesMeet) {
  // IEC 61966-2-1 rounds where they do: to four digits.
  const double below = linearOf(0.04045), above = linearOf(std::nextafter(0.04045, 1.0));
  EXPECT_NEAR(below, 0.0031308, 5e-8);
  EXPECT_NEAR(above, below, 5e-8);
  EXPECT_EQ(linearOf(0.0), 0.0);
  EXPECT_EQ(linearOf(1.0), 1.0);
}

TEST(Srgb, IsTheSameInFloatAndDouble) {
  for (int byte = 0; byte < 256; ++byte) {
    const double wide = linearOf(byte / 255.0);
    // Some roundings of floats; the power takes those of its base 2.4 times.
    EXPECT_NEAR(linearOf(static_cast<std::uint8_t>(byte)), wide, 8.0 * 0x1p-24 * wide);
    EXPECT_EQ(srgb(static_cast<float>(wide)), byte);
  }
}

}  // namespace srgb_test
}  // namespace sdf
