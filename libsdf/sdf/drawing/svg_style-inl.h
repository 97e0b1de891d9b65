// What is filled and stroked in an SVG drawing, and how. Private to drawing/.
#pragma once
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "sdf/outline/outline.h"

namespace sdf {

/// What an element hands on to those in it.
struct SvgStyle {
  bool isFilled = true, isStroked = false, isVisible = true;
  FillRule rule = FillRule::NonZero;
  Stroke stroke{.join = Stroke::Join::Miter, .cap = Stroke::Cap::Butt};
};

/// A length in units of the drawing; none where it has another unit, or is no number.
std::optional<double> svgLength(std::string text);

/// The declarations of a drawing's style sheets, by class: of their selectors these alone are known.
class SvgSheet {
 public:
  explicit SvgSheet(const pugi::xml_node& drawing);
  /// An element's style: its own in that of the element around it. `isDrawn` becomes false where it, with
  /// all in it, is not.
  SvgStyle styleOf(const pugi::xml_node& element, SvgStyle style, bool& isDrawn) const;

 private:
  void read(std::string_view text);
  std::map<std::string, std::string, std::less<>> classes_;
};

}  // namespace sdf
