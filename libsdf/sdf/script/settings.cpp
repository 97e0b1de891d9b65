// Materials, parts, parameters, the camera, lights and everything else that is said once per scene.
#include <algorithm>
#include <cmath>
#include <cstdio>
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

std::string subject(lua_State* L) { return runningFunction(L).name; }

int setCamera(lua_State* L) {
  once(L);
  expectArguments(L, 1, 1);
  Camera& c = contextOf(L).scene.camera;
  const FieldReader o(L, 1, runningFunction(L));
  c.from = o.vector("from", c.from);
  c.to = o.vector("to", c.to);
  c.up = o.vector("up", c.up);
  c.fov = o.number("fov", c.fov, Rule::Positive);
  if (uniformValue(c.fov) >= 180.0) raise(L, "camera: 'fov' must be below 180 degrees");
  if (uniformValue(length(c.from - c.to)) == 0.0)
    raise(L, "camera: 'from' and 'to' must be different points");
  c.mirrored = o.flag("mirrored", c.mirrored);
  return 0;
}

int addLight(lua_State* L, Light::Kind kind, const char* vectorName) {
  expectArguments(L, 0, 1);
  const FieldReader o(L, 1, runningFunction(L));
  Light light;
  light.kind = kind;
  light.vector = o.vector(vectorName, light.vector);
  if (kind == Light::Kind::Directional && uniformValue(length(light.vector)) == 0.0)
    raise(L, o.what(vectorName) + " must not be {0, 0, 0}");
  light.color = o.color("color", light.color, Depends::OnParameters);
  light.intensity = o.number("intensity", light.intensity, Rule::NotNegative);
  light.castsShadow = o.flag("shadow", light.castsShadow);
  contextOf(L).scene.lights.push_back(light);
  return 0;
}
int addDirectionalLight(lua_State* L) { return addLight(L, Light::Kind::Directional, "direction"); }
int addPointLight(lua_State* L) { return addLight(L, Light::Kind::Point, "position"); }

int setAmbient(lua_State* L) {
  once(L);
  expectArguments(L, 1, 1);
  contextOf(L).scene.ambient = readColor(L, 1, subject(L), Depends::OnParameters);
  return 0;
}

int setBackground(lua_State* L) {
  once(L);
  expectArguments(L, 1, 1);
  contextOf(L).scene.background = readColor(L, 1, subject(L), Depends::OnPosition);
  return 0;
}

int setFog(lua_State* L) {
  once(L);
  expectArguments(L, 1, 1);
  Fog& fog = contextOf(L).scene.fog;
  const FieldReader o(L, 1, runningFunction(L));
  fog.color = o.color("color", fog.color, Depends::OnParameters);
  fog.density = o.number("density", fog.density, Rule::NotNegative);
  return 0;
}

int setShadows(lua_State* L) {
  once(L);
  expectArguments(L, 0, 1);
  Shadow& s = contextOf(L).scene.shadow;
  const FieldReader o(L, 1, runningFunction(L));
  s.kind = static_cast<Shadow::Kind>(
      o.choice("kind", {"none", "hard", "soft", "improved", "signed"}, static_cast<int>(Shadow::Kind::Soft)));
  s.sharpness = o.number("sharpness", s.sharpness, Rule::Positive);
  s.start = o.plain("start", s.start, Rule::Positive);
  s.reach = o.plain("reach", s.reach, Rule::Positive);
  s.steps = o.integer("steps", s.steps, 1);
  return 0;
}

int setAmbientOcclusion(lua_State* L) {
  once(L);
  expectArguments(L, 0, 1);
  AmbientOcclusion& a = contextOf(L).scene.ambientOcclusion;
  const FieldReader o(L, 1, runningFunction(L));
  a.kind = static_cast<AmbientOcclusion::Kind>(
      o.choice("kind", {"none", "taps", "steps"}, static_cast<int>(AmbientOcclusion::Kind::Taps)));
  a.spacing = o.plain("spacing", a.spacing, Rule::Positive);
  a.count = o.integer("count", a.count, 1);
  a.strength = o.number("strength", a.strength, Rule::NotNegative);
  return 0;
}

int setReflections(lua_State* L) {
  once(L);
  expectArguments(L, 1, 1);
  contextOf(L).scene.reflectionBounces = FieldReader(L, 1, runningFunction(L)).integer("bounces", 1, 0);
  return 0;
}

std::string numberText(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", v);
  return text;
}

double positiveArgument(lua_State* L) {
  once(L);
  expectArguments(L, 1, 1);
  const double v = readPlainNumber(L, 1, subject(L));
  if (!(v > 0.0)) raise(L, subject(L) + " must be positive, got " + numberText(v));
  return v;
}
int setMaxDistance(lua_State* L) {
  constexpr double kMost = 1e15;  // the squares of more are beyond a GPU's floats
  const double v = positiveArgument(L);
  if (v > kMost) raise(L, subject(L) + " must be at most 1e15, got " + numberText(v));
  contextOf(L).scene.maxDistance = v;
  return 0;
}
int setGamma(lua_State* L) { return contextOf(L).scene.gamma = positiveArgument(L), 0; }

int setBounds(lua_State* L) {
  once(L);
  expectArguments(L, 2, 2);
  contextOf(L).scene.bounds = readBox(L, 1, 2, subject(L));
  return 0;
}

const std::vector<FieldInfo>& materialFields() {
  static const std::vector<FieldInfo> fields{
      {"name", "text", "\"material N\"", "shown in the exported file"},
      {"color", "colour", "0.8", "diffuse colour"},
      {"ambient", "colour", "the colour", "answer to the ambient light"},
      {"specular", "colour", "0", "colour of the highlight"},
      {"shininess", "number or function", "32", "Phong exponent; larger is tighter"},
      {"reflectivity", "number or function", "0",
       "mirrors reflectivity * (fresnel_bias + (1 - cos)^fresnel_power) of the light, at most all of it"},
      {"fresnel_power", "number or function", "0",
       "larger: only grazing views mirror; cos is that of the angle between view and normal"},
      {"fresnel_bias", "number or function", "0", "what is mirrored straight on as well"},
      {"emission", "colour", "0", "light of its own"}};
  return fields;
}

int newMaterial(lua_State* L);

// The fields are the material's own, whichever function took them.
const FunctionInfo& materialFunction() {
  static const FunctionInfo info{"material", "material{color = c, shininess = 32}", "how a surface looks",
                                 materialFields(), newMaterial};
  return info;
}

MaterialPtr materialFrom(lua_State* L, int index) {
  const FieldReader o(L, index, materialFunction());
  Material m;
  m.name = o.text("name", m.name);
  m.color = o.color("color", m.color, Depends::OnPosition);
  if (o.has("ambient")) m.ambient = o.color("ambient", m.color, Depends::OnPosition);
  m.specular = o.color("specular", m.specular, Depends::OnPosition);
  m.shininess = o.surfaceNumber("shininess", m.shininess, Rule::Positive);
  m.reflectivity = o.surfaceNumber("reflectivity", m.reflectivity, Rule::NotNegative);
  m.fresnelPower = o.surfaceNumber("fresnel_power", m.fresnelPower, Rule::NotNegative);
  m.fresnelBias = o.surfaceNumber("fresnel_bias", m.fresnelBias, Rule::NotNegative);
  m.emission = o.color("emission", m.emission, Depends::OnPosition);
  return makeMaterial(std::move(m));
}

int newMaterial(lua_State* L) {
  expectArguments(L, 1, 1);
  return pushMaterial(L, materialFrom(L, 1)), 1;
}

bool hasNames(lua_State* L, int index) {
  lua_pushnil(L);
  const bool some = lua_next(L, index);
  const bool named = some && lua_type(L, -2) == LUA_TSTRING;
  lua_pop(L, some ? 2 : 0);
  return named;
}

// A material, its fields, or only a colour.
int paint(lua_State* L) {
  expectArguments(L, 2, 2);
  const Shape& shape = readShape(L, 1, "paint: the first argument");
  if (const MaterialPtr* material = testMaterial(L, 2)) return pushShape(L, shape.paint(*material)), 1;
  if (lua_istable(L, 2) && hasNames(L, 2)) return pushShape(L, shape.paint(materialFrom(L, 2))), 1;
  Material m;
  m.color = readColor(L, 2, "paint: the material or its colour", Depends::OnPosition);
  return pushShape(L, shape.paint(std::move(m))), 1;
}

int addPart(lua_State* L) {
  expectArguments(L, 2, 2);
  const std::string name = readText(L, 1, "part: the name");
  const Shape& shape = readShape(L, 2, "part: the second argument");
  if (shape.dimension != 3) raise(L, "part '" + name + "' is flat; extrude or revolve it");
  Scene& scene = contextOf(L).scene;
  const auto same = [&](const Part& p) { return p.name == name; };
  if (name.empty()) raise(L, "part: the name must not be empty");
  if (std::any_of(scene.parts.begin(), scene.parts.end(), same))
    raise(L, "part '" + name + "' exists already; give each part a name of its own");
  scene.add(name, shape);
  lua_settop(L, 2);
  return 1;
}

int newParameter(lua_State* L) {
  expectArguments(L, 2, 3);
  ScriptContext& context = contextOf(L);
  ParameterInfo p;
  p.name = readText(L, 1, "param: the name");
  if (p.name.empty() || p.name.find('=') != std::string::npos)
    raise(L, "param: the name must be a word without '=', got \"" + p.name + "\"");
  if (p.name == "time") raise(L, "param: 'time' is the scene's clock; give the parameter another name");
  const std::string what = "param '" + p.name + "'";
  const double usual = readPlainNumber(L, 2, what + ": the default");
  const FieldReader o(L, 3, runningFunction(L));
  p.min = o.plain("min", std::min(0.0, usual));
  p.max = o.plain("max", std::max({1.0, usual, p.min}));
  if (!(p.min <= usual && usual <= p.max))
    raise(L, what + ": the default " + numberText(usual) + " is outside " + numberText(p.min) + " … " +
                 numberText(p.max));
  const auto given = context.options.values.find(p.name);
  p.value = given == context.options.values.end() ? usual : given->second;
  if (!std::isfinite(p.value)) raise(L, what + " must be a finite number, got " + numberText(p.value));
  const auto [earlier, fresh] = context.parameterDefaults.try_emplace(p.name, usual);
  auto& list = context.scene.parameters;
  const auto same = [&](const ParameterInfo& other) { return other.name == p.name; };
  const auto it = std::find_if(list.begin(), list.end(), same);
  if (fresh)
    list.push_back(p);
  else if (!(*it == p) || earlier->second != usual)
    raise(L, what + " exists already with another default or range; use the same, or another name");
  return pushExpr(L, context.options.fixed ? Expr(p.value) : Expr::parameter(p)), 1;
}

std::vector<FieldInfo> lightFields(FieldInfo vector) {
  return {std::move(vector),
          {"color", "colour", "1", "linear RGB"},
          {"intensity", "number", "1", "factor of the colour; does not fall off with distance"},
          {"shadow", "true or false", "true", "whether it casts shadows"}};
}

}  // namespace

const std::vector<FunctionInfo>& settingLibrary() {
  static const std::vector<FunctionInfo> library{
      {"part", "part(\"name\", shape)", "adds a shape under a name of its own; returns it", {}, addPart},
      {"param",
       "param(\"name\", default, {min = 0, max = 1})",
       "a number that can be changed from outside (`-D name=value`, a slider); the range widens to hold the "
       "default",
       {{"min", "number", "0", "least value it is meant for"}, {"max", "number", "1", "greatest"}},
       newParameter},
      materialFunction(),
      {"paint",
       "shape:paint(material)",
       "the shape all in one material, given as a material, its fields, or only a colour",
       {},
       paint},
      {"camera",
       "camera{from = {0, 1.5, 6}, to = {0, 0, 0}}",
       "where the scene is seen from",
       {{"from", "{x, y, z}", "{0, 1.5, 6}", "the eye"},
        {"to", "{x, y, z}", "{0, 0, 0}", "the point in the middle of the picture"},
        {"up", "{x, y, z}", "{0, 1, 0}", "what is up"},
        {"fov", "number", "45", "vertical field of view, degrees"},
        {"mirrored", "true or false", "false", "swaps left and right"}},
       setCamera},
      {"directional_light", "directional_light{direction = {1, 1, 1}}",
       "adds a light from far away; a scene that has no light and does not call `ambient` gets this one",
       lightFields({"direction", "{x, y, z}", "{1, 1, 1}", "towards the light"}), addDirectionalLight},
      {"point_light", "point_light{position = {1, 1, 1}}", "adds a light at a point",
       lightFields({"position", "{x, y, z}", "{1, 1, 1}", "where it is"}), addPointLight},
      {"ambient", "ambient(color)", "light that comes from everywhere; 0.1 unless set", {}, setAmbient},
      {"background",
       "background(color)",
       "what a ray sees that hits nothing; in a function, x, y, z are the ray's unit direction",
       {},
       setBackground},
      {"fog",
       "fog{color = c, density = 0.1}",
       "mixes far surfaces into a colour; the share that is kept is exp(-density * distance)",
       {{"color", "colour", "0", "colour of the fog"}, {"density", "number", "0", "per unit of length"}},
       setFog},
      {"shadows",
       "shadows{kind = \"soft\"}",
       "makes lights cast shadows",
       {{"kind", "\"none\", \"hard\", \"soft\", \"improved\" or \"signed\"", "\"soft\"", "method"},
        {"sharpness", "number", "8", "of soft edges; larger is harder"},
        {"start", "number", "0.02", "distance from the surface at which the shadow ray starts"},
        {"reach", "number", "20", "how far it goes"},
        {"steps", "whole number", "50", "at most"}},
       setShadows},
      {"ambient_occlusion",
       "ambient_occlusion{kind = \"taps\"}",
       "darkens crevices",
       {{"kind", "\"none\", \"taps\" or \"steps\"", "\"taps\"",
         "samples along the normal, or the count of steps"},
        {"spacing", "number", "0.08", "taps: distance between samples"},
        {"count", "whole number", "5", "taps: how many"},
        {"strength", "number", "0.2", "taps: weight of each; steps: darkening of each step"}},
       setAmbientOcclusion},
      {"reflections",
       "reflections{bounces = 1}",
       "how often mirrored rays are followed",
       {{"bounces", "whole number", "1", "0: no reflections"}},
       setReflections},
      {"max_distance", "max_distance(80)", "how far the camera sees", {}, setMaxDistance},
      {"gamma",
       "gamma(2.2)",
       "exponent of the picture's tone curve; sRGB unless set, 1 for raw values",
       {},
       setGamma},
      {"bounds",
       "bounds({x0, y0, z0}, {x1, y1, z1})",
       "the box that an unbounded scene is clipped to when it is meshed",
       {},
       setBounds},
  };
  return library;
}

}  // namespace sdf
