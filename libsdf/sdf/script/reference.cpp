#include "sdf/script/reference.h"

#include <string_view>
#include <utility>

#include "sdf/script/library.h"

namespace sdf {

namespace {

// What a parameter takes, by ArgumentKind.
std::string formOf(const Parameter& p) {
  static constexpr const char* kForms[] = {"number", "whole number",         "`{x, y}`", "`{x, y, z}`",
                                           "",       "points `{{x, y}, …}`", "shape",    "shapes"};
  return p.kind == ArgumentKind::Choice ? shown(p.choices) : kForms[static_cast<int>(p.kind)];
}

void addEntry(std::string& out, const CatalogEntry& e) {
  out += "\n#### `" + usageOf(e) + "`\n\n" + e.doc + "\n\nDistance: " + e.claim + ".\n\n";
  for (const Parameter& p : e.parameters) {
    out += "- `" + p.name + "`: " + p.doc + " (" + formOf(p) +
           (p.rule == Rule::Any ? "" : std::string(", ") + wording(p.rule));
    if (p.kind == ArgumentKind::Choice)
      out += "; default `\"" + p.fallback + "\"`";
    else if (!p.fallback.empty())
      out += "; default `" + p.fallback + "`";
    else if (!p.required)
      out += "; optional";
    out += ")\n";
  }
}

void addGroup(std::string& out, Group group, const std::string& title, const std::string& intro) {
  out += "\n### " + title + "\n" + (intro.empty() ? "" : "\n" + intro + "\n");
  for (const CatalogEntry& e : catalog())
    if (e.group == group) addEntry(out, e);
}

// A field without documentation of its own is all that the function takes.
void addFunction(std::string& out, const FunctionInfo& f) {
  out += "- `" + f.usage + "`: " + f.doc;
  for (const SettingInfo& field : f.fields)
    out += (field.doc.empty() ? "" : "\n  - `" + field.name + "`: " + field.doc) + " (" + wording(field) +
           "; default " + field.unset + ")";
  out += "\n";
}

void addLibrary(std::string& out, const std::string& title, const std::vector<FunctionInfo>& functions) {
  out += "\n### " + title + "\n\n";
  for (const FunctionInfo& f : functions) addFunction(out, f);
}

constexpr std::string_view kBegin = "<!-- reference: begin (made from the code; do not edit) -->\n";
constexpr std::string_view kEnd = "<!-- reference: end -->";

}  // namespace

std::string sceneReference() {
  std::string out;
  addGroup(out, Group::Solid, "Solids",
           "Negative inside, y up, centred at the origin unless they say otherwise.");
  addLibrary(out, "Free form", shapeLibrary());
  addGroup(out, Group::Flat, "Flat shapes",
           "They lie in x and y, and become solids by `extrude` or `revolve`.");
  addGroup(
      out, Group::Boolean, "Combining",
      "`a | b`, `a & b`, `a - b` and `a ~ b` are the union, intersection, difference and xor of two shapes.");
  addGroup(out, Group::Deform, "Changing", "");
  addGroup(out, Group::Place, "Placing", "");
  addGroup(out, Group::Pattern, "Repeating", "");
  addLibrary(out, "Scene, materials and settings", settingLibrary());
  addLibrary(out, "Colours and patterns", patternLibrary());
  addLibrary(out, "Numbers and formulas", formulaLibrary());
  return out;
}

Result<std::string> withSceneReference(const std::string& page) {
  const std::size_t begin = page.find(kBegin), end = page.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    return Error{ErrorKind::Files, "the page lacks the lines that mark the reference"};
  return page.substr(0, begin + kBegin.size()) + sceneReference() + "\n" + page.substr(end);
}

}  // namespace sdf
