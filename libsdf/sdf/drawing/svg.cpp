#include "sdf/drawing/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <utility>

#include "sdf/base/read_file.h"
#include "sdf/drawing/svg_style-inl.h"
#include "sdf/drawing/svg_transform.h"
#include "sdf/outline/ellipse_arc.h"
#include "sdf/outline/path_data.h"

namespace sdf {
namespace {

constexpr std::uintmax_t kMostBytes = 20'000'000;
// Elements within one another, and all that are looked at, those that are used several times as often.
constexpr int kDeepest = 64;
constexpr std::size_t kMostElements = 200'000;

Error sceneError(const std::string& message) { return {ErrorKind::Scene, message}; }
Error tooMany(std::size_t most, const std::string& of) {
  return {ErrorKind::Limits, "it has more than " + std::to_string(most) + of};
}

// Without its namespace.
std::string nameOf(const pugi::xml_node& element) {
  const std::string name = element.name();
  return name.substr(name.find(':') + 1);
}

Contour polygonOf(const std::vector<double>& numbers, bool isClosed) {
  Contour contour{{numbers[0], numbers[1]}, {}, isClosed};
  for (std::size_t i = 2; i + 1 < numbers.size(); i += 2)
    contour.curves.push_back({0, {}, {numbers[i], numbers[i + 1]}});
  return contour;
}

// Two halves of an ellipse.
Contour ellipseOf(const glm::dvec2& centre, const glm::dvec2& radii) {
  const glm::dvec2 right = centre + glm::dvec2(radii.x, 0.0), left = centre - glm::dvec2(radii.x, 0.0);
  Contour contour{right, curvesOf(right, {radii, 0.0, false, true, left}), true};
  for (const Curve& c : curvesOf(left, {radii, 0.0, false, true, right})) contour.curves.push_back(c);
  return contour;
}

Contour rectangleOf(const glm::dvec2& at, const glm::dvec2& size, const glm::dvec2& radii) {
  const glm::dvec2 end = at + size;
  Contour contour{{at.x + radii.x, at.y}, {}, true};
  const auto side = [&](const glm::dvec2& to, const glm::dvec2& corner) {
    contour.curves.push_back({0, {}, to});
    for (const Curve& c : curvesOf(to, {radii, 0.0, false, true, corner})) contour.curves.push_back(c);
  };
  side({end.x - radii.x, at.y}, {end.x, at.y + radii.y});
  side({end.x, end.y - radii.y}, {end.x - radii.x, end.y});
  side({at.x + radii.x, end.y}, {at.x, end.y - radii.y});
  side({at.x, at.y + radii.y}, {at.x + radii.x, at.y});
  return contour;
}

class SvgReader {
 public:
  explicit SvgReader(const pugi::xml_document& document) : document_(document), sheet_(document) {}

  Result<std::vector<Outline>> read() {
    const pugi::xml_node root = document_.document_element();
    if (nameOf(root) != "svg") return sceneError("it is no SVG drawing: its outermost element is no svg");
    bool isDrawn = true;
    const SvgStyle style = sheet_.styleOf(root, {}, isDrawn);
    const Affine up{{1.0, 0.0, 0.0, -1.0}, {}};  // y is up
    if (const Status done = children(root, up, style, 0); !done) return done.error();
    if (outlines_.empty())
      return sceneError(
          "it fills and strokes nothing; make text to paths (in Inkscape: Path > Object to Path)");
    return std::move(outlines_);
  }

 private:
  Status children(const pugi::xml_node& parent, const Affine& place, const SvgStyle& style, int depth) {
    for (const pugi::xml_node& child : parent.children())
      if (child.type() == pugi::node_element)
        if (const Status done = element(child, place, style, depth); !done) return done;
    return okStatus();
  }

  Status element(const pugi::xml_node& e, Affine place, SvgStyle style, int depth) {
    if (depth > kDeepest)
      return sceneError("its elements are more than " + std::to_string(kDeepest) + " deep; ungroup some");
    if (++elements_ > kMostElements) return tooMany(kMostElements, " elements");
    bool isDrawn = true;
    style = sheet_.styleOf(e, style, isDrawn);
    if (!isDrawn) return okStatus();
    if (const pugi::xml_attribute given = e.attribute("transform")) {
      const auto transform = transformOf(given.value());
      if (!transform) return wrong(e, "transform", "a transform");
      place = place * *transform;
    }
    const std::string name = nameOf(e);
    if (name == "g" || name == "a" || name == "switch") return children(e, place, style, depth + 1);
    if (name == "svg" || name == "use") return placed(e, name, place, style, depth);
    if (!style.isVisible || (!style.isFilled && !style.isStroked)) return okStatus();
    auto contours = contoursOf(e, name);
    if (!contours) return contours.error();
    return take(std::move(*contours), place, style, name != "line");
  }

  // What has its own x and y.
  Status placed(const pugi::xml_node& e, const std::string& name, Affine place, const SvgStyle& style,
                int depth) {
    const auto at = lengths(e, {"x", "y"});
    if (!at) return at.error();
    place = place * Affine{glm::dmat2(1.0), {(*at)[0], (*at)[1]}};
    if (name == "svg") return children(e, place, style, depth + 1);
    const pugi::xml_attribute plain = e.attribute("href");
    const std::string href = plain ? plain.value() : e.attribute("xlink:href").value();
    const pugi::xml_node used = href.starts_with('#') ? named(href.substr(1)) : pugi::xml_node();
    if (!used) return wrong(e, plain ? "href" : "xlink:href", "the # and id of an element");
    if (nameOf(used) == "symbol") return children(used, place, style, depth + 1);
    return element(used, place, style, depth + 1);
  }
  pugi::xml_node named(const std::string& id) const {
    return document_.find_node([&](const pugi::xml_node& n) { return n.attribute("id").value() == id; });
  }

  // None of elements that draw nothing.
  Result<std::vector<Contour>> contoursOf(const pugi::xml_node& e, const std::string& name) const {
    if (name == "path") {
      auto contours = pathContours(e.attribute("d").value());
      if (!contours) return Error{contours.error().kind, inElement(e) + contours.error().message};
      return contours;
    }
    if (name == "polygon" || name == "polyline") {
      const auto numbers = numbersIn(e.attribute("points").value());
      if (!numbers || numbers->size() % 2 != 0) return wrong(e, "points", "pairs of numbers");
      return numbers->empty() ? std::vector<Contour>{}
                              : std::vector<Contour>{polygonOf(*numbers, name == "polygon")};
    }
    if (name == "line") {
      const auto n = lengths(e, {"x1", "y1", "x2", "y2"});
      if (!n) return n.error();
      return std::vector<Contour>{polygonOf({n->begin(), n->end()}, false)};
    }
    if (name == "circle") {
      const auto n = lengths(e, {"cx", "cy", "r"});
      if (!n) return n.error();
      return round({(*n)[0], (*n)[1]}, glm::dvec2((*n)[2]));
    }
    if (name == "ellipse") {
      const auto n = lengths(e, {"cx", "cy", "rx", "ry"});
      if (!n) return n.error();
      return round({(*n)[0], (*n)[1]}, {(*n)[2], (*n)[3]});
    }
    if (name == "rect") return rectangle(e);
    return std::vector<Contour>{};
  }
  static std::vector<Contour> round(const glm::dvec2& centre, const glm::dvec2& radii) {
    if (!(radii.x > 0.0 && radii.y > 0.0)) return {};
    return {ellipseOf(centre, radii)};
  }
  Result<std::vector<Contour>> rectangle(const pugi::xml_node& e) const {
    const auto n = lengths(e, {"x", "y", "width", "height", "rx", "ry"});
    if (!n) return n.error();
    const auto [x, y, width, height, rx, ry] = *n;
    if (!(width > 0.0 && height > 0.0)) return std::vector<Contour>{};
    // One radius stands for both.
    const glm::dvec2 radii(e.attribute("rx") ? rx : ry, e.attribute("ry") ? ry : rx);
    return std::vector<Contour>{
        rectangleOf({x, y}, {width, height},
                    {std::clamp(radii.x, 0.0, 0.5 * width), std::clamp(radii.y, 0.0, 0.5 * height)})};
  }

  // Lengths in units of the drawing; those that are not there are 0.
  template <std::size_t n>
  Result<std::array<double, n>> lengths(const pugi::xml_node& e, const char* const (&names)[n]) const {
    std::array<double, n> found{};
    for (std::size_t i = 0; i < n; ++i) {
      const pugi::xml_attribute given = e.attribute(names[i]);
      if (!given) continue;
      const auto length = svgLength(given.value());
      if (!length) return wrong(e, names[i], "a length");
      found[i] = *length;
    }
    return found;
  }

  Status take(std::vector<Contour> contours, const Affine& place, const SvgStyle& style, bool mayFill) {
    for (Contour& contour : contours) {
      contour.from = place(contour.from);
      for (Curve& c : contour.curves) {
        for (int i = 0; i < c.controls; ++i) c.control[i] = place(c.control[i]);
        c.to = place(c.to);
      }
      curves_ += contour.curves.size();
    }
    if (curves_ > kMostCurves) return tooMany(kMostCurves, " curves; simplify its paths");
    if (contours.empty()) return okStatus();
    Stroke stroke = style.stroke;
    const double stretch = std::sqrt(std::abs(glm::determinant(place.turn)));
    stroke.width *= stretch, stroke.dashOffset *= stretch;
    for (double& length : stroke.dashes) length *= stretch;
    if (style.isStroked && stroke.width > 0.0) outlines_.push_back({contours, FillRule::NonZero, stroke});
    if (style.isFilled && mayFill) outlines_.push_back({std::move(contours), style.rule, {}});
    return okStatus();
  }

  // "path 'id': ", or without one.
  static std::string inElement(const pugi::xml_node& e) {
    const std::string id = e.attribute("id").value();
    return nameOf(e) + (id.empty() ? "" : " '" + id + "'") + ": ";
  }
  static Error wrong(const pugi::xml_node& e, const std::string& attribute, const std::string& wanted) {
    constexpr std::size_t kShown = 40;
    const std::string value = e.attribute(attribute.c_str()).value();
    return sceneError(inElement(e) + attribute + " must be " + wanted + ", got \"" + value.substr(0, kShown) +
                      (value.size() > kShown ? "…\"" : "\""));
  }

  const pugi::xml_document& document_;
  SvgSheet sheet_;
  std::vector<Outline> outlines_;
  std::size_t curves_ = 0, elements_ = 0;
};

}  // namespace

Result<std::vector<Outline>> svgOutlines(const std::filesystem::path& file) {
  const Result<std::string> bytes = readFile(file, kMostBytes, "simplify the drawing");
  if (!bytes) return bytes.error();
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(bytes->data(), bytes->size());
  if (!parsed) {
    const auto end =
        bytes->begin() + std::min<std::ptrdiff_t>(parsed.offset, static_cast<std::ptrdiff_t>(bytes->size()));
    return unreadable(file, "it is no SVG drawing: " + std::string(parsed.description()) + " in line " +
                                std::to_string(1 + std::count(bytes->begin(), end, '\n')));
  }
  auto outlines = SvgReader(document).read();
  if (!outlines) return Error{outlines.error().kind, unreadable(file, outlines.error().message).message};
  return outlines;
}

}  // namespace sdf
