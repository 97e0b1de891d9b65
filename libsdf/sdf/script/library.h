// The parts of the scene language besides the catalog, each with what the reference page says of it.
#pragma once
#include <string>
#include <vector>

#include "sdf/scene/settings.h"
#include "sdf/script/values.h"
#include "sdf/shape/catalog.h"

namespace sdf {

/// A global function or value of the scene language.
struct FunctionInfo {
  std::string name;
  std::string usage;  ///< as written in a scene
  std::string doc;
  std::vector<SettingInfo> fields;  ///< of its options table; `unset` is the default
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

/// "sphere(radius)".
std::string usageOf(const CatalogEntry& entry);
/// Raises for a name in the table at `index` that the function does not know, with the nearest or all that it
/// knows; and for a value without a name, unless there is no usage to show.
void checkNames(lua_State* L, int index, const std::string& function, const std::vector<std::string>& known,
                const std::string& usage = "");

/// A value of the field's kind: a box as two corners, in a table or at this place and the next.
SettingValue readSetting(lua_State* L, int index, const std::string& what, const SettingInfo& field);

/// The function's fields that are given in the table at `index`, "camera{fov = 40}"; none where nothing is
/// there. Unknown names are refused, and values that a field cannot take.
using FieldValues = std::map<std::string, SettingValue>;
FieldValues readFields(lua_State* L, int index, const FunctionInfo& function);
template <class T>
T valueOr(const FieldValues& values, const std::string& field, const T& fallback) {
  const auto it = values.find(field);
  return it == values.end() ? fallback : std::get<T>(it->second);
}

/// The setting as a function of the language, with the defaults that its Owner has after `begin`.
template <class Owner>
FunctionInfo functionOf(const Setting<Owner>& setting, LibraryFunction call) {
  Owner usual;
  if (setting.begin) setting.begin(usual);
  FunctionInfo f{setting.name, setting.usage, setting.doc, {}, call};
  for (const SettingField<Owner>& field : setting.fields) {
    f.fields.push_back(field);
    f.fields.back().unset = written(field, field.get(usual));
  }
  return f;
}

/// Fills the owner's members from the call's arguments, the first of which is at `index`.
template <class Owner>
void readSettings(lua_State* L, int index, const FunctionInfo& f, const Setting<Owner>& setting,
                  Owner& owner) {
  const std::string& first = setting.fields[0].name;
  const FieldValues values = setting.alone ? FieldValues{{first, readSetting(L, index, f.name, f.fields[0])}}
                                           : readFields(L, index, f);
  if (const Status applied = apply(setting, values, owner); !applied) raise(L, applied.error().message);
}

/// Raises "camera: too many arguments; write camera{from = …}" where more than `most` are given.
void expectArguments(lua_State* L, int least, int most);

}  // namespace sdf
