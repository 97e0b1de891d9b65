// Pictures that a test finds in files.
#pragma once
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "sdf/meshfile/picture.h"
#include "viewer/gpu/picture.h"

namespace sdf::test {

/// Reads a PNG as so many bytes a pixel, 3 or 4.
inline viewer::Picture readPng(const std::filesystem::path& file, int channels = 4) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto image = PictureReader().read(bytes);
  if (!image) throw std::runtime_error(file.string() + ": " + image.error().message);
  viewer::Picture picture{image->width, image->height, channels, {}};
  for (std::size_t i = 0; i < image->pixels.size(); ++i)
    if (static_cast<int>(i % 4) < channels) picture.bytes.push_back(image->pixels[i]);
  return picture;
}

}  // namespace sdf::test
