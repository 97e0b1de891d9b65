// Where fonts are.
#pragma once
#include <filesystem>
#include <string>

#include "sdf/base/result.h"

namespace sdf {

/// A font: a file, and which of the fonts in it.
struct FontFile {
  std::filesystem::path path;
  int index = 0;
};

/// Is it the name of a font's file, by its extension (.ttf, .otf, .ttc, .otc, .woff or .woff2)? Else it is
/// that of a family.
bool isFontFile(const std::string& name);

/// The font of a family that this machine has, by fontconfig: "DejaVu Sans", or "DejaVu Sans:bold:italic".
/// Errors: Files, where it has none of this name.
Result<FontFile> findFont(const std::string& family);

}  // namespace sdf
