#include "sdf/drawing/svg_style-inl.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "sdf/drawing/svg_transform.h"

namespace sdf {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

// Calls take(part) for each part between separators.
void forEachPart(std::string_view text, char separator, const std::function<void(std::string_view)>& take) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    take(trimmed(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

// None where one is no length, or negative: the line is whole then.
std::vector<double> dashesIn(std::string_view value) {
  std::string spaced(value);
  std::ranges::replace_if(
      spaced, [](char c) { return c == ',' || c == '\t' || c == '\r' || c == '\n'; }, ' ');
  std::vector<double> dashes;
  bool areLengths = true;
  forEachPart(spaced, ' ', [&](std::string_view part) {
    if (part.empty()) return;
    const auto length = svgLength(std::string(part));
    areLengths = areLengths && length && *length >= 0.0;
    if (areLengths) dashes.push_back(*length);
  });
  return areLengths ? dashes : std::vector<double>();
}

void declare(std::string_view name, std::string_view value, SvgStyle& style, bool& isDrawn) {
  if (value == "inherit") return;
  if (name == "fill") style.isFilled = value != "none" && value != "transparent";
  if (name == "fill-rule") style.rule = value == "evenodd" ? FillRule::EvenOdd : FillRule::NonZero;
  if (name == "stroke") style.isStroked = value != "none" && value != "transparent";
  if (name == "stroke-linejoin")
    style.stroke.join = value == "round"   ? Stroke::Join::Round
                        : value == "bevel" ? Stroke::Join::Bevel
                                           : Stroke::Join::Miter;
  if (name == "stroke-linecap")
    style.stroke.cap = value == "round"    ? Stroke::Cap::Round
                       : value == "square" ? Stroke::Cap::Square
                                           : Stroke::Cap::Butt;
  if (name == "stroke-width") style.stroke.width = svgLength(std::string(value)).value_or(style.stroke.width);
  if (name == "stroke-miterlimit")
    style.stroke.miterLimit = svgLength(std::string(value)).value_or(style.stroke.miterLimit);
  if (name == "stroke-dasharray") style.stroke.dashes = dashesIn(value);
  if (name == "stroke-dashoffset")
    style.stroke.dashOffset = svgLength(std::string(value)).value_or(style.stroke.dashOffset);
  if (name == "visibility") style.isVisible = value == "visible";
  if (name == "display") isDrawn = value != "none";
}

void declareAll(std::string_view text, SvgStyle& style, bool& isDrawn) {
  forEachPart(text, ';', [&](std::string_view part) {
    const std::size_t colon = part.find(':');
    if (colon == std::string_view::npos) return;
    declare(trimmed(part.substr(0, colon)), trimmed(part.substr(colon + 1)), style, isDrawn);
  });
}

}  // namespace

std::optional<double> svgLength(std::string text) {
  constexpr std::pair<const char*, double> kUnits[] = {
      {"px", 1.0}, {"pt", 96.0 / 72.0}, {"pc", 16.0}, {"mm", 96.0 / 25.4}, {"cm", 96.0 / 2.54}, {"in", 96.0}};
  double unit = 1.0;
  for (const auto& [name, size] : kUnits)
    if (text.ends_with(name)) {
      unit = size, text.resize(text.size() - 2);
      break;
    }
  const auto numbers = numbersIn(text);
  if (!numbers || numbers->size() != 1) return {};
  return unit * numbers->front();
}

SvgSheet::SvgSheet(const pugi::xml_node& drawing) {
  for (const pugi::xpath_node& found : drawing.select_nodes("//*[local-name() = 'style']"))
    for (const pugi::xml_node& text : found.node().children()) read(text.value());
}

void SvgSheet::read(std::string_view text) {
  for (std::size_t open; (open = text.find('{')) != std::string_view::npos;) {
    const std::size_t close = std::min(text.find('}', open), text.size());
    forEachPart(text.substr(0, open), ',', [&](std::string_view selector) {
      if (!selector.starts_with('.')) return;
      std::string& known = classes_[std::string(selector.substr(1))];
      known += text.substr(open + 1, close - open - 1);
      known += ';';
    });
    text.remove_prefix(std::min(close + 1, text.size()));
  }
}

// Attributes count least, and an element's own style most.
SvgStyle SvgSheet::styleOf(const pugi::xml_node& element, SvgStyle style, bool& isDrawn) const {
  for (const pugi::xml_attribute& a : element.attributes())
    declare(a.name(), trimmed(a.value()), style, isDrawn);
  forEachPart(element.attribute("class").value(), ' ', [&](std::string_view name) {
    if (const auto known = classes_.find(name); known != classes_.end())
      declareAll(known->second, style, isDrawn);
  });
  declareAll(element.attribute("style").value(), style, isDrawn);
  return style;
}

}  // namespace sdf
