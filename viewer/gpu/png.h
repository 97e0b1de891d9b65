// Pictures as PNG files, eight bits a channel.
#pragma once
#include <filesystem>

#include "sdf/base/result.h"
#include "viewer/gpu/picture.h"

namespace sdf::viewer {

/// Writes the picture under the name, whole or not at all (see sdf/base/file.h). The picture must have
/// width * height * channels bytes, at least one. Errors: those of writeFile; Limits if memory runs out.
Status writePng(const std::filesystem::path& target, const Picture& picture);

/// Reads any PNG as `channels` (3 or 4) bytes a pixel. Errors: Files.
Result<Picture> readPng(const std::filesystem::path& source, int channels = 4);

}  // namespace sdf::viewer
