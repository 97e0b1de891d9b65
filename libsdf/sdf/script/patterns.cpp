// Colours that vary over space: formulas of the position that materials and backgrounds take.
#include <array>
#include <lua.hpp>

#include "sdf/scene/patterns.h"
#include "sdf/script/library.h"

namespace sdf {

namespace {

Vec3E colorArgument(lua_State* L, int i) {
  return readColor(L, i, runningFunction(L).name + ": colour " + std::to_string(i), Depends::OnPosition);
}

// The first three arguments.
Vec3E numberArguments(lua_State* L, const std::string& what) {
  const auto at = [&](int i) { return readNumber(L, i, what + std::to_string(i), Depends::OnPosition); };
  return {at(1), at(2), at(3)};
}

int makeColor(lua_State* L) {
  expectArguments(L, 1, 3);
  const std::string what = runningFunction(L).name + ": argument ";
  if (lua_gettop(L) == 1) return pushResult(L, readColor(L, 1, what + "1", Depends::OnPosition)), 1;
  expectArguments(L, 3, 3);
  return pushResult(L, numberArguments(L, what)), 1;
}

int makeCheckerboard(lua_State* L) {
  expectArguments(L, 2, 3);
  const Vec3E a = colorArgument(L, 1), b = colorArgument(L, 2);
  const Expr scale = valueOr(readFields(L, 3, runningFunction(L)), "scale", Expr(1.0));
  return pushResult(L, checkerboard(a, b, scale)), 1;
}

int makeGradient(lua_State* L) {
  expectArguments(L, 3, 4);
  const std::string axisName = runningFunction(L).name + ": the axis";
  const Vec3E p = position();
  Expr along;
  if (lua_type(L, 1) == LUA_TSTRING)
    along = std::array{p.x, p.y, p.z}[readChoice(L, 1, axisName, {"x", "y", "z"})];
  else
    along = dot(p, readVector(L, 1, axisName, 3, Depends::OnParameters));
  const Vec3E a = colorArgument(L, 2), b = colorArgument(L, 3);
  const FieldValues ends = readFields(L, 4, runningFunction(L));
  const Expr from = valueOr(ends, "from", Expr(0.0)), to = valueOr(ends, "to", Expr(1.0));
  if (uniformValue(to - from) == 0.0) raise(L, "gradient: 'from' and 'to' must be different");
  return pushResult(L, gradient(along, a, b, from, to)), 1;
}

int makeVerticalGradient(lua_State* L) {
  expectArguments(L, 2, 2);
  const Vec3E bottom = colorArgument(L, 1), top = colorArgument(L, 2);
  return pushResult(L, verticalGradient(bottom, top)), 1;
}

int octavesOf(lua_State* L, const FunctionInfo& f, const FieldValues& given) {
  constexpr int kMostOctaves = 8;  // the ninth would be weaker than a step of an 8-bit colour
  const int octaves = valueOr(given, "octaves", 1);
  if (octaves > kMostOctaves)
    raise(L, f.name + ": 'octaves' must be 8 or less, got " + std::to_string(octaves));
  return octaves;
}

std::uint32_t seedOf(const FieldValues& given) {
  return static_cast<std::uint32_t>(valueOr(given, "seed", 0));
}

int makeNoise(lua_State* L) {
  expectArguments(L, 3, 4);
  const Vec3E p = numberArguments(L, "noise: coordinate ");
  const FunctionInfo& f = runningFunction(L);
  return pushResult(L, noise(p, octavesOf(L, f, readFields(L, 4, f)))), 1;
}

template <LatticeNoise::Kind kind>
int makeSmoothNoise(lua_State* L) {
  expectArguments(L, 3, 4);
  const FunctionInfo& f = runningFunction(L);
  const Vec3E p = numberArguments(L, f.name + ": coordinate ");
  const FieldValues given = readFields(L, 4, f);
  return pushResult(L, latticeNoise(kind, p,
                                    {.count = octavesOf(L, f, given),
                                     .ridged = valueOr(given, "ridged", false),
                                     .seed = seedOf(given)})),
         1;
}

int makeCellNoise(lua_State* L) {
  expectArguments(L, 3, 4);
  const FunctionInfo& f = runningFunction(L);
  const Vec3E p = numberArguments(L, f.name + ": coordinate ");
  const FieldValues given = readFields(L, 4, f);
  using enum LatticeNoise::Kind;
  const LatticeNoise::Kind kind = std::array{Nearest, Second, Border}[valueOr(given, "kind", 0)];
  return pushResult(L, latticeNoise(kind, p, {.seed = seedOf(given)})), 1;
}

int makeSky(lua_State* L) {
  expectArguments(L, 0, 1);
  Sky sky;
  readSettings(L, 1, runningFunction(L), skySetting(), sky);
  return pushResult(L, skyColor(sky)), 1;
}

}  // namespace

// clang-format off
const std::vector<FunctionInfo>& patternLibrary() {
  using enum SettingKind;
  const SettingInfo seed{"seed", Integer, "another number gives another noise", Rule::NotNegative, {}, "0"};
  const std::vector<SettingInfo> smooth{{"octaves", Integer, "as of `noise`", Rule::Positive, {}, "1"},
                                        {"ridged", Flag, "is each octave 1 - 2 abs(n), with sharp ridges?", Rule::Any, {}, "false"},
                                        seed};
  static const std::vector<FunctionInfo> library{
      {"color", "color(r, g, b)", "any form of a colour as {r, g, b}, linear", {}, makeColor},
      {"checkerboard", "checkerboard(a, b, {scale = 1})", "squares of two colours in x and z",
       {{"scale", Number, "length of a square's side", Rule::Positive, {}, "1"}}, makeCheckerboard},
      {"gradient", "gradient(\"y\", a, b, {from = 0, to = 1})",
       "from colour a to colour b along \"x\", \"y\", \"z\" or a direction {x, y, z}",
       {{"from", Number, "where it is a", Rule::Any, {}, "0"}, {"to", Number, "where it is b", Rule::Any, {}, "1"}},
       makeGradient},
      {"vertical_gradient", "vertical_gradient(bottom, top)", "a background: bottom straight down, top straight up",
       {}, makeVerticalGradient},
      functionOf(skySetting(), makeSky),
      {"noise", "noise(x, y, z, {octaves = 1})",
       "a smooth irregular number in -1 … 1 that varies over about one unit; a sum of sines, the same in float and in double",
       {{"octaves", Integer, "up to 8; each adds detail half as large and half as strong", Rule::Positive, {}, "1"}},
       makeNoise},
      {"gradient_noise", "gradient_noise(x, y, z, {octaves = 1, ridged = false, seed = 0})",
       "Perlin's: a smooth random number in -1 … 1, 0 where x, y and z are whole; its slope is 3.84 at most",
       smooth,
       makeSmoothNoise<LatticeNoise::Kind::Gradient>},
      {"value_noise", "value_noise(x, y, z, {octaves = 1, ridged = false, seed = 0})",
       "a smooth random number in -1 … 1 between random numbers where x, y and z are whole; its slope is 3.75 at most",
       smooth,
       makeSmoothNoise<LatticeNoise::Kind::Value>},
      {"cell_noise", "cell_noise(x, y, z, {kind = \"nearest\", seed = 0})",
       "Worley's: the distance to random points, one in each cube of side 1; up to 1.73",
       {{"kind", Choice, "the distance to the nearest point, to the second nearest, or how much farther that is, which is 0 on the borders between the points' cells; the slope of the last is 2 at most", Rule::Any, {"nearest", "second", "border"}, "\"nearest\""},
        seed},
       makeCellNoise},
  };
  return library;
}
// clang-format on

}  // namespace sdf
