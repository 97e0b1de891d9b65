// Pictures in main memory.
#pragma once
#include <cstdint>
#include <vector>

namespace sdf::viewer {

/// A Picture holds rows from the top, pixels from the left, `channels` bytes each, nothing between them.
struct Picture {
  int width = 0, height = 0;
  int channels = 0;  ///< 3: RGB, 4: RGBA (alpha not premultiplied)
  std::vector<std::uint8_t> bytes;
};

}  // namespace sdf::viewer
