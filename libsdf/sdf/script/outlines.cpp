#include "sdf/script/outlines.h"

#include <algorithm>
#include <lua.hpp>

#include "sdf/font/text_outline.h"
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

constexpr CurveTolerance kCurveTolerance{1e-6, 1e-4};  // of the font's size
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

}  // namespace

int textShape(lua_State* L) {
  expectArguments(L, 1, 2);
  const FunctionInfo& f = runningFunction(L);
  if (lua_type(L, 1) != LUA_TSTRING)
    raise(L, f.name + ": the text must be a string, got " + describe(L, 1) + "; write " + f.usage);
  const std::string text = textAt(L, 1);
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
  if (!shape.ok()) raise(L, *shape.error);
  return pushShape(L, shape), 1;
}

}  // namespace sdf
