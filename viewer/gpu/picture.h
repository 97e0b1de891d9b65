// Pictures in main memory, and as PNG files of eight bits a channel.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "sdf/base/result.h"

namespace sdf::viewer {

/// A Picture holds rows from the top, pixels from the left, `channels` bytes each, nothing between them.
struct Picture {
  int width = 0, height = 0;
  int channels = 0;  ///< 3: RGB, 4: RGBA (alpha not premultiplied)
  std::vector<std::uint8_t> bytes;
};

/// Is this a name that pictures can be written under, one that ends in .png? Errors: Usage.
Status checkPictureName(const std::filesystem::path& target);

/// Writes the picture under the name, whole or not at all (see sdf/base/file.h). The picture must have
/// width * height * channels bytes, at least one. Errors: those of writeFile; Limits if memory runs out.
Status writePng(const std::filesystem::path& target, const Picture& picture);

}  // namespace sdf::viewer
