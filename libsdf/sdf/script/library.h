// The parts of the scene language besides the catalog, each with what the reference page says of it.
#pragma once
#include <string>
#include <vector>

#include "sdf/script/values.h"
#include "sdf/shape/catalog.h"

namespace sdf {

/// A named field of an options table.
struct FieldInfo {
  std::string name;
  std::string form;  ///< what it takes, in words: "number", "{x, y, z}"
  std::string fallback;
  std::string doc;
};

/// A global function or value of the scene language.
struct FunctionInfo {
  std::string name;
  std::string usage;  ///< as written in a scene
  std::string doc;
  std::vector<FieldInfo> fields;
  LibraryFunction call;
};

/// Functions of numbers and formulas: sin, mix, select …
const std::vector<FunctionInfo>& formulaLibrary();
/// Colours and patterns: checkerboard, gradient, noise …
const std::vector<FunctionInfo>& patternLibrary();
/// Materials, parts, parameters, camera, lights and settings.
const std::vector<FunctionInfo>& settingLibrary();
/// Shapes written as formulas.
const std::vector<FunctionInfo>& shapeLibrary();

/// The function of a library that a lua_State is running.
const FunctionInfo& runningFunction(lua_State* L);

/// Makes functions global; those of shapes are methods as well.
void openLibrary(lua_State* L, const std::vector<FunctionInfo>& functions);
/// Makes every entry of the catalog global, and a method where its first parameter is a shape or shapes; and
/// the operators | & - ~ of shapes.
void openCatalog(lua_State* L);
/// Makes + - * / // % ^ work on formulas, and comparisons explain themselves.
void openFormulaOperators(lua_State* L);

/// Opens everything that a script can name, and nothing else. A lua_CFunction.
int openLanguage(lua_State* L);

/// A table of named fields: "camera{fov = 40}". Unknown names are refused.
class FieldReader {
 public:
  /// The table at `index`, or no fields at all where nothing is there. `context` starts messages ("camera").
  FieldReader(lua_State* L, int index, const FunctionInfo& function);

  bool has(const char* field) const;
  Expr number(const char* field, const Expr& fallback, Rule rule = Rule::Any) const;
  double plain(const char* field, double fallback, Rule rule = Rule::Any) const;
  int integer(const char* field, int fallback, int least) const;
  bool flag(const char* field, bool fallback) const;
  std::string text(const char* field, const std::string& fallback) const;
  int choice(const char* field, const std::vector<std::string>& choices, int fallback) const;
  Vec3E vector(const char* field, const Vec3E& fallback) const;
  Vec3E color(const char* field, const Vec3E& fallback, Depends depends) const;
  Expr surfaceNumber(const char* field, const Expr& fallback, Rule rule = Rule::Any) const;
  /// {{x0, y0, z0}, {x1, y1, z1}}
  std::optional<Box> box(const char* field) const;
  /// Whether a field holds nothing but what `test` accepts is for the caller; this gives its place on the
  /// stack, pushed, or 0.
  int push(const char* field) const;
  std::string what(const char* field) const;

 private:
  void checkRule(const char* field, const Expr& e, Rule rule) const;

  lua_State* L_;
  int index_;
  const FunctionInfo& function_;
};

/// Raises "camera: too many arguments; write camera{from = …}" where more than `most` are given.
void expectArguments(lua_State* L, int least, int most);
/// A box from the two corners at these places.
Box readBox(lua_State* L, int low, int high, const std::string& what);

}  // namespace sdf
