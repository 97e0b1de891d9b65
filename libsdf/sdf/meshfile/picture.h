// PNG and JPEG pictures.
#pragma once
#include <string_view>

#include "sdf/base/result.h"
#include "sdf/triangles/triangle_mesh.h"

namespace sdf {

/// Decodes pictures, so many pixels in all, whatever their files promise.
class PictureReader {
 public:
  /// The error's message is a part of a sentence: "it is no PNG or JPEG".
  Result<TextureImage> read(std::string_view file);

 private:
  std::size_t pixelsLeft_ = std::size_t{1} << 28;
};

}  // namespace sdf
