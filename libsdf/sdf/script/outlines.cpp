#include "sdf/script/outlines.h"

#include <algorithm>
#include <lua.hpp>

#include "sdf/drawing/svg.h"
#include "sdf/font/text_outline.h"
#include "sdf/outline/path_data.h"
#include "sdf/outline/side_tree.h"
#include "sdf/script/context.h"
#include "sdf/script/library.h"
#include "sdf/script/meshes.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/flats.h"

namespace sdf {

void addOnce(std::vector<std::string>& all, const std::string& one) {
  if (std::ranges::find(all, one) == all.end()) all.push_back(one);
}

int pushMissing(lua_State* L, const std::string& why) {
  ScriptContext& c = contextOf(L);
  if (!c.options.withoutMissing) raise(L, why);
  addOnce(c.scene.missing, c.file + ":" + std::to_string(currentLine(L)) + ": " + why);
  return pushShape(L, Shape::failed(why)), 1;
}

namespace {

constexpr CurveTolerance kCurveTolerance{1e-6, 1e-4};  // of the font's size, or the longest side
constexpr const char* kUsualFont = "DejaVu Sans";

// The font of this name, a file or a family.
Result<FontFile> fontOf(lua_State* L, const std::string& name) {
  ScriptContext& c = contextOf(L);
  if (!isFontFile(name)) {
    Result<FontFile> found = findFont(name);
    if (found) return found;
    const std::string package = name == kUsualFont ? " (on Debian: fonts-dejavu-core)" : "";
    return Error{found.error().kind, "text: " + found.error().message + package};
  }
  const auto file = permitted(name, c.file, c.options, "text");
  if (!file) return file.error();
  addOnce(c.scene.files, file->string());
  return FontFile{*file, 0};
}

// The first argument.
std::string stringGiven(lua_State* L, const FunctionInfo& f, const std::string& what) {
  if (lua_type(L, 1) != LUA_TSTRING)
    raise(L, f.name + ": the " + what + " must be a string, got " + describe(L, 1) + "; write " + f.usage);
  return textAt(L, 1);
}

// Exact to some millionths of the longest side.
Shape shapeOf(std::span<const Outline> outlines, const std::string& name) {
  Rectangle box;
  for (const Outline& outline : outlines)
    for (const Contour& contour : outline.contours) {
      box.add(contour.from);
      for (const Curve& c : contour.curves) {
        for (int i = 0; i < c.controls; ++i) box.add(c.control[i]);
        box.add(c.to);
      }
    }
  const glm::dvec2 sides = box.hi - box.lo;
  const double size = std::max(sides.x, sides.y);
  if (!(size > 0.0)) return Shape::failed(name + ": it encloses no area");
  return outline(outlines, {size * kCurveTolerance.exact, size * kCurveTolerance.drawn}, name);
}

}  // namespace

int pathShape(lua_State* L) {
  expectArguments(L, 1, 2);
  const FunctionInfo& f = runningFunction(L);
  const std::string data = stringGiven(L, f, "path");
  const FieldValues given = readFields(L, 2, f);
  auto contours = pathContours(data);
  if (!contours) raise(L, f.name + ": " + contours.error().message);
  Outline outline{std::move(*contours), static_cast<FillRule>(valueOr(given, "rule", 0)), {}};
  if (const double width = valueOr(given, "stroke", 0.0); width > 0.0)
    outline.stroke = {.width = width,
                      .join = static_cast<Stroke::Join>(valueOr(given, "join", 0)),
                      .cap = static_cast<Stroke::Cap>(valueOr(given, "cap", 0))};
  if (const double dash = valueOr(given, "dash", -1.0), gap = valueOr(given, "gap", dash);
      outline.stroke && dash >= 0.0) {
    if (gap == 0.0) raise(L, f.name + ": dots need a gap, as in {dash = 0, gap = 0.2}");
    outline.stroke->dashes = {dash, gap};
  }
  const Shape shape = shapeOf({&outline, 1}, f.name);
  return pushGood(L, shape);
}

// Its middle is the origin.
int svgShape(lua_State* L) {
  expectArguments(L, 1, 2);
  const FunctionInfo& f = runningFunction(L);
  const std::string name = stringGiven(L, f, "file");
  const FieldValues given = readFields(L, 2, f);
  ScriptContext& c = contextOf(L);
  const auto file = permitted(name, c.file, c.options, f.name);
  if (!file) return pushMissing(L, file.error().message);
  addOnce(c.scene.files, file->string());
  const auto outlines = svgOutlines(*file);
  if (!outlines) return pushMissing(L, f.name + ": " + outlines.error().message);
  const Shape drawing = shapeOf(*outlines, f.name);
  if (!drawing.ok()) raise(L, *drawing.error);
  const glm::dvec3 middle = drawing.bounds.centre(), sides = drawing.bounds.size();
  const Shape centred = translate(drawing, Vec3E(-middle.x, -middle.y, 0.0));
  const Expr size = valueOr<Expr>(given, "size", 1.0);
  const Shape shape = scale(centred, size / std::max(sides.x, sides.y));
  return pushGood(L, shape);
}

int textShape(lua_State* L) {
  expectArguments(L, 1, 2);
  const FunctionInfo& f = runningFunction(L);
  const std::string text = stringGiven(L, f, "text");
  const FieldValues given = readFields(L, 2, f);
  TextStyle style;
  style.align = static_cast<TextStyle::Align>(valueOr(given, "align", 0));
  style.spacing = valueOr(given, "spacing", style.spacing);
  style.lineSpacing = valueOr(given, "line_spacing", style.lineSpacing);
  const auto font = fontOf(L, valueOr<std::string>(given, "font", kUsualFont));
  if (!font) return pushMissing(L, font.error().message);
  const auto letters = textOutline(text, *font, style);
  if (!letters && letters.error().kind == ErrorKind::Scene) raise(L, f.name + ": " + letters.error().message);
  if (!letters) return pushMissing(L, f.name + ": " + letters.error().message);
  const Shape shape = scale(outline(*letters, kCurveTolerance, f.name), valueOr<Expr>(given, "size", 1.0));
  return pushGood(L, shape);
}

}  // namespace sdf
