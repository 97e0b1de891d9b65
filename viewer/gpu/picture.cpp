#include "viewer/gpu/picture.h"

#include <cassert>
#include <ostream>
#include <string>

#include "sdf/base/file.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

namespace sdf::viewer {

Status checkPictureName(const std::filesystem::path& target) {
  constexpr std::string_view kKnown[] = {".png"};
  return checkExtension(target, kKnown);
}

Status writePng(const std::filesystem::path& target, const Picture& picture) {
  const int width = picture.width, height = picture.height, channels = picture.channels;
  assert(width > 0 && height > 0 && (channels == 3 || channels == 4));
  assert(picture.bytes.size() == std::size_t(width) * std::size_t(height) * std::size_t(channels));
  const auto append = [](void* stream, void* data, int size) {
    static_cast<std::ostream*>(stream)->write(static_cast<const char*>(data), size);
  };
  return writeFile(target, [&](std::ostream& out) -> Status {
    const auto* const bytes = picture.bytes.data();
    if (stbi_write_png_to_func(append, &out, width, height, channels, bytes, width * channels) == 0)
      return Error{ErrorKind::Limits, "no memory is left to write '" + target.string() + "'"};
    return okStatus();
  });
}

}  // namespace sdf::viewer
