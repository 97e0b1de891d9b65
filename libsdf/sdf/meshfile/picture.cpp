// Pictures through tinygltf's decoder, which is stb_image.
#include "sdf/meshfile/picture.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace sdf {
namespace {

struct Size {
  std::size_t width, height;
};

class BigEndian {
 public:
  explicit BigEndian(std::string_view bytes) : bytes_(bytes) {}
  std::size_t byte(std::size_t i) const { return static_cast<unsigned char>(bytes_[i]); }
  std::size_t pair(std::size_t i) const { return byte(i) << 8 | byte(i + 1); }
  std::size_t four(std::size_t i) const { return pair(i) << 16 | pair(i + 2); }

 private:
  std::string_view bytes_;
};

/// PNG (ISO 15948), 11.2.2: the header comes first.
std::optional<Size> pngSize(std::string_view file) {
  constexpr std::string_view kMagic("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
  if (!file.starts_with(kMagic) || file.size() < 24) return std::nullopt;
  return Size{BigEndian(file).four(16), BigEndian(file).four(20)};
}

/// JPEG (ITU T.81), B.1.1: the size stands in the frame's header, SOF.
std::optional<Size> jpegSize(std::string_view file) {
  const BigEndian at(file);
  if (!file.starts_with("\xFF\xD8\xFF")) return std::nullopt;
  for (std::size_t i = 2; i + 9 <= file.size() && at.byte(i) == 0xFF;) {
    const std::size_t marker = at.byte(i + 1);
    if (marker == 0xFF) {  // a filler
      ++i;
      continue;
    }
    const bool isFrame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (isFrame) return Size{at.pair(i + 7), at.pair(i + 5)};
    i += 2 + at.pair(i + 2);
  }
  return std::nullopt;
}

}  // namespace

Result<TextureImage> PictureReader::read(std::string_view file) {
  const auto bad = [](const char* what) { return Error{ErrorKind::Files, what}; };
  const std::optional<Size> png = pngSize(file), size = png ? png : jpegSize(file);
  if (!size) return bad("it is no PNG or JPEG");
  constexpr std::size_t kLongestSide = 1 << 14, kMostPixels = 1 << 26;  // the decoder counts bytes in an int
  const std::size_t pixels = size->width * size->height;
  if (std::max(size->width, size->height) > kLongestSide || pixels > std::min(kMostPixels, pixelsLeft_))
    return bad("it is too large");
  // Deflate makes at most 1032 bytes of one (RFC 1951), and a byte holds at most 8 pixels.
  if (file.size() > std::numeric_limits<int>::max() || (png && pixels / (1032 * 8) > file.size()))
    return bad("it is broken");

  tinygltf::Image decoded;
  if (!tinygltf::LoadImageData(&decoded, 0, nullptr, nullptr, 0, 0,
                               reinterpret_cast<const unsigned char*>(file.data()),
                               static_cast<int>(file.size()), nullptr) ||
      decoded.component != 4)
    return bad("it is broken");
  pixelsLeft_ -= pixels;
  if (decoded.bits == 16) {  // little-endian, as the machine; the upper bytes suffice
    for (std::size_t i = 0; i < decoded.image.size() / 2; ++i) decoded.image[i] = decoded.image[2 * i + 1];
    decoded.image.resize(decoded.image.size() / 2);
  }
  return TextureImage{decoded.width, decoded.height, std::move(decoded.image)};
}

}  // namespace sdf
