// Text as outlines.
#pragma once
#include <string>

#include "sdf/base/result.h"
#include "sdf/font/font_file.h"
#include "sdf/outline/outline.h"

namespace sdf {

/// Longer texts are refused.
inline constexpr std::size_t kMostTextBytes = 20'000;

struct TextStyle {
  enum class Align { Left, Center, Right };
  Align align = Align::Left;  ///< of lines, at x = 0
  double spacing = 0.0;       ///< between letters, beside what the font says, in sizes of the font
  double lineSpacing = 1.0;   ///< between lines, in what the font says
};

/// The outlines of a text in UTF-8, the font's size (its em) being 1. The first line's baseline is y = 0;
/// "\n" begins a line below. HarfBuzz shapes each line: kerning, ligatures (none where letters are spaced),
/// and the direction of the line's script. FreeType gives the outlines, without hints. Variable fonts are
/// taken as they are by default.
///
/// Errors: Scene (no UTF-8, control characters, more than kMostTextBytes, nothing to be seen, characters that
/// the font lacks); Files (the file cannot be read, or is no TrueType or OpenType font with outlines).
Result<Outline> textOutline(const std::string& text, const FontFile& font, const TextStyle& style = {});

}  // namespace sdf
