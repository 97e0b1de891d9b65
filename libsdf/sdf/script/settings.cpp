// Materials, parts, parameters, the camera, lights and everything else that is said once per scene.
#include <algorithm>
#include <cmath>
#include <lua.hpp>

#include "sdf/script/context.h"
#include "sdf/script/library.h"

namespace sdf {

namespace {

// A setting that is made twice is a mistake more often than a wish.
void once(lua_State* L) {
  const std::string& name = runningFunction(L).name;
  const auto [it, fresh] = contextOf(L).settingLines.try_emplace(name, currentLine(L));
  if (!fresh) raise(L, name + " is already set on line " + std::to_string(it->second) + "; set it once");
}

template <class Owner>
const Setting<Owner>& runningSetting(lua_State* L, const std::vector<Setting<Owner>>& settings) {
  return *std::ranges::find(settings, runningFunction(L).name, &Setting<Owner>::name);
}

int makeSetting(lua_State* L) {
  once(L);
  const Setting<Scene>& setting = runningSetting(L, sceneSettings());
  const int values = setting.alone && setting.fields[0].kind == SettingKind::Box ? 2 : 1;
  expectArguments(L, setting.begin ? 0 : values, values);
  return readSettings(L, 1, runningFunction(L), setting, contextOf(L).scene), 0;
}

int addLight(lua_State* L) {
  expectArguments(L, 0, 1);
  Light light;
  readSettings(L, 1, runningFunction(L), runningSetting(L, lightSettings()), light);
  return contextOf(L).scene.lights.push_back(light), 0;
}

// Materials are numbered as they are made, so that a scene's names depend on nothing but the scene.
MaterialPtr numbered(lua_State* L, Material m) {
  const int number = ++contextOf(L).materials;
  if (m.name.empty()) m.name = "material " + std::to_string(number);
  return makeMaterial(std::move(m));
}

int newMaterial(lua_State* L);

// The fields are the material's own, whichever function took them.
const FunctionInfo& materialFunction() {
  static const FunctionInfo info = functionOf(materialSetting(), newMaterial);
  return info;
}

MaterialPtr materialFrom(lua_State* L, int index) {
  Material m;
  readSettings(L, index, materialFunction(), materialSetting(), m);
  return numbered(L, std::move(m));
}

int newMaterial(lua_State* L) {
  expectArguments(L, 1, 1);
  return pushMaterial(L, materialFrom(L, 1)), 1;
}

// A material, its fields, or only a colour.
int paint(lua_State* L) {
  expectArguments(L, 2, 2);
  const Shape& shape = readShape(L, 1, "paint: the first argument");
  if (const MaterialPtr* material = testMaterial(L, 2)) return pushShape(L, shape.paint(*material)), 1;
  if (lua_istable(L, 2) && hasNamedField(L, 2)) return pushShape(L, shape.paint(materialFrom(L, 2))), 1;
  Material m;
  m.color = readColor(L, 2, "paint: the material or its colour", Depends::OnPosition);
  return pushShape(L, shape.paint(numbered(L, std::move(m)))), 1;
}

int addPart(lua_State* L) {
  expectArguments(L, 2, 2);
  const std::string name = readText(L, 1, "part: the name");
  const Shape& shape = readShape(L, 2, "part: the second argument");
  if (shape.dimension != 3) raise(L, "part '" + name + "' is flat; extrude or revolve it");
  Scene& scene = contextOf(L).scene;
  if (name.empty()) raise(L, "part: the name must not be empty");
  if (!contextOf(L).partNames.insert(name).second)
    raise(L, "part '" + name + "' exists already; give each part a name of its own");
  if (!isMissing(shape)) scene.add(name, shape);
  lua_settop(L, 2);
  return 1;
}

int newParameter(lua_State* L) {
  expectArguments(L, 2, 3);
  ScriptContext& context = contextOf(L);
  ParameterInfo p;
  p.name = readText(L, 1, "param: the name");
  if (p.name.empty() || p.name.find('=') != std::string::npos)
    raise(L, "param: the name must be a word without '=', got " + inLuaQuotes(p.name));
  if (p.name == "time") raise(L, "param: 'time' is the scene's clock; give the parameter another name");
  const std::string what = "param '" + p.name + "'";
  const double usual = readPlainNumber(L, 2, what + ": the default");
  const FieldValues range = readFields(L, 3, runningFunction(L));
  p.min = valueOr(range, "min", std::min(0.0, usual));
  p.max = valueOr(range, "max", std::max({1.0, usual, p.min}));
  if (!(p.min <= usual && usual <= p.max))
    raise(L, what + ": the default " + shown(usual) + " is outside " + shown(p.min) + " … " + shown(p.max));
  const auto given = context.options.values.find(p.name);
  p.value = given == context.options.values.end() ? usual : given->second;
  if (context.options.tolerant) p.value = std::clamp(p.value, p.min, p.max);
  if (!std::isfinite(p.value)) raise(L, what + " must be a finite number, got " + shown(p.value));
  const auto [earlier, fresh] = context.parameterDefaults.try_emplace(p.name, usual);
  auto& list = context.scene.parameters;
  if (fresh)
    list.push_back(p);
  else if (*std::ranges::find(list, p.name, &ParameterInfo::name) != p || earlier->second != usual)
    raise(L, what + " exists already with another default or range; use the same, or another name");
  return pushFormula(L, inputOf(context, p)), 1;
}

}  // namespace

// clang-format off
const std::vector<FunctionInfo>& settingLibrary() {
  using enum SettingKind;
  static const std::vector<FunctionInfo> library = [] {
    std::vector<FunctionInfo> functions{
        {"part", "part(\"name\", shape)", "adds a shape under a name of its own; returns it", {}, addPart},
        {"param", "param(\"name\", default, {min = 0, max = 1})",
         "a number that can be changed from outside (`-D name=value`, a slider); the range widens to hold the default",
         {{"min", PlainNumber, "least value it is meant for", Rule::Any, {}, "0"},
          {"max", PlainNumber, "greatest", Rule::Any, {}, "1"}},
         newParameter},
        materialFunction(),
        {"paint", "shape:paint(material)",
         "the shape all in one material, given as a material, its fields, or only a colour", {}, paint}};
    for (const Setting<Light>& s : lightSettings()) functions.push_back(functionOf(s, addLight));
    for (const Setting<Scene>& s : sceneSettings()) functions.push_back(functionOf(s, makeSetting));
    return functions;
  }();
  return library;
}
// clang-format on

}  // namespace sdf
