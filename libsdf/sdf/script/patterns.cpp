// Colours that vary over space: formulas of the position that materials and backgrounds take.
#include <array>
#include <cmath>
#include <lua.hpp>
#include <numbers>

#include "sdf/script/library.h"

namespace sdf {

namespace {

Vec3E colorArgument(lua_State* L, int i) {
  return readColor(L, i, runningFunction(L).name + ": colour " + std::to_string(i), Depends::OnPosition);
}

int makeColor(lua_State* L) {
  expectArguments(L, 1, 3);
  const std::string what = runningFunction(L).name + ": argument ";
  if (lua_gettop(L) == 1) return pushVector(L, readColor(L, 1, what + "1", Depends::OnPosition)), 1;
  expectArguments(L, 3, 3);
  std::array<Expr, 3> c;
  for (int i = 0; i < 3; ++i) c[i] = readNumber(L, i + 1, what + std::to_string(i + 1), Depends::OnPosition);
  return pushVector(L, {c[0], c[1], c[2]}), 1;
}

// The squares lie in x and z, as on a floor.
int checkerboard(lua_State* L) {
  expectArguments(L, 2, 3);
  const Vec3E a = colorArgument(L, 1), b = colorArgument(L, 2);
  const Expr scale = Options(L, 3, runningFunction(L)).number("scale", 1.0, Rule::Positive);
  const Vec3E p = position();
  const Expr odd = mod(floor(p.x / scale) + floor(p.z / scale), 2.0);
  return pushVector(L, {select(odd, b.x, a.x), select(odd, b.y, a.y), select(odd, b.z, a.z)}), 1;
}

int gradient(lua_State* L) {
  expectArguments(L, 3, 4);
  const std::string axisName = runningFunction(L).name + ": the axis";
  const Vec3E p = position();
  Expr along;
  if (lua_type(L, 1) == LUA_TSTRING)
    along = std::array{p.x, p.y, p.z}[readChoice(L, 1, axisName, {"x", "y", "z"})];
  else
    along = dot(p, readVector(L, 1, axisName, 3, Depends::OnParameters));
  const Vec3E a = colorArgument(L, 2), b = colorArgument(L, 3);
  const Options options(L, 4, runningFunction(L));
  const Expr from = options.number("from", 0.0), to = options.number("to", 1.0);
  return pushVector(L, mix(a, b, clamp((along - from) / (to - from), 0.0, 1.0))), 1;
}

int verticalGradient(lua_State* L) {
  expectArguments(L, 2, 2);
  const Vec3E bottom = colorArgument(L, 1), top = colorArgument(L, 2);
  return pushVector(L, mix(bottom, top, clamp(0.5 + 0.5 * position().y, 0.0, 1.0))), 1;
}

// One octave: the mean of three sines whose directions are at right angles and whose phases are bent by a
// fourth and a fifth, so that no period shows. All slopes are of order one, so that an error of the
// coordinate is not amplified: the usual hash, the fraction of a large multiple of a sine, differs between
// float and double at every point.
Expr sines(const Vec3E& p) {
  const Expr u = 2.3 * (0.36 * p.x + 0.48 * p.y + 0.80 * p.z);
  const Expr v = 2.9 * (-0.80 * p.x + 0.60 * p.y);
  const Expr w = 2.6 * (-0.48 * p.x - 0.64 * p.y + 0.60 * p.z);
  const Expr bend = sin(0.73 * (u - v) + 1.7), turn = cos(0.61 * (v + w) + 0.4);
  const Expr sum = sin(u + 1.3 * turn) + sin(v + 1.1 * bend) + sin(w + 1.2 * bend * turn + 0.9);
  return sum * (1.0 / 3.0);
}

int noise(lua_State* L) {
  expectArguments(L, 3, 4);
  const std::string what = runningFunction(L).name + ": coordinate ";
  Vec3E p{readNumber(L, 1, what + "1", Depends::OnPosition),
          readNumber(L, 2, what + "2", Depends::OnPosition),
          readNumber(L, 3, what + "3", Depends::OnPosition)};
  constexpr int kMostOctaves = 8;  // the ninth would be below 1/256, less than a colour's step
  const int octaves = Options(L, 4, runningFunction(L)).integer("octaves", 1, 1);
  if (octaves > kMostOctaves) raise(L, "noise: 'octaves' must be 8 or less, got " + std::to_string(octaves));
  Expr sum = 0.0;
  double weight = 1.0, total = 0.0, frequency = 1.0;
  for (int i = 0; i < octaves; ++i, total += weight, weight *= 0.5, frequency *= 2.03)
    sum = sum + weight * sines(p * Expr(frequency) + Vec3E(Expr(5.1 * i)));
  return pushExpr(L, sum * (1.0 / total)), 1;
}

int sky(lua_State* L) {
  expectArguments(L, 0, 1);
  const Options o(L, 1, runningFunction(L));
  const Vec3E horizon = o.color("horizon", {0.7, 0.8, 0.9}, Depends::OnParameters);
  const Vec3E zenith = o.color("zenith", {0.15, 0.35, 0.7}, Depends::OnParameters);
  const Vec3E ground = o.color("ground", horizon, Depends::OnParameters);
  const Vec3E ray = position();
  Vec3E color = mix(horizon, zenith, sqrt(max(ray.y, 0.0)));
  color = mix(color, ground, clamp(ray.y * -8.0, 0.0, 1.0));
  if (o.has("sun")) {
    const Vec3E sun = o.vector("sun", {});
    const Expr facing = max(dot(ray, sun) / length(sun), 0.0);
    color = color + o.color("sun_color", {1.0, 0.9, 0.7}, Depends::OnParameters) *
                        pow(facing, o.number("sun_size", 256.0, Rule::Positive));
  }
  return pushVector(L, color), 1;
}

}  // namespace

const std::vector<FunctionInfo>& patternLibrary() {
  static const std::vector<FunctionInfo> library{
      {"color", "color(r, g, b)", "any form of a colour as {r, g, b}, linear", {}, makeColor},
      {"checkerboard",
       "checkerboard(a, b, {scale = 1})",
       "squares of two colours in x and z",
       {{"scale", "number", "1", "length of a square's side"}},
       checkerboard},
      {"gradient",
       "gradient(\"y\", a, b, {from = 0, to = 1})",
       "from colour a to colour b along \"x\", \"y\", \"z\" or a direction {x, y, z}",
       {{"from", "number", "0", "where it is a"}, {"to", "number", "1", "where it is b"}},
       gradient},
      {"vertical_gradient",
       "vertical_gradient(bottom, top)",
       "a background: bottom straight down, top straight up",
       {},
       verticalGradient},
      {"sky",
       "sky{horizon = c, zenith = c, sun = {1, 1, 0}}",
       "a background with a horizon and, where its direction is given, a sun",
       {{"horizon", "colour", "{0.7, 0.8, 0.9}", "at eye level"},
        {"zenith", "colour", "{0.15, 0.35, 0.7}", "straight up"},
        {"ground", "colour", "the horizon", "below the horizon"},
        {"sun", "{x, y, z}", "none", "direction of the sun"},
        {"sun_color", "colour", "{1, 0.9, 0.7}", "added where the ray meets the sun"},
        {"sun_size", "number", "256", "exponent of its glow; larger is smaller"}},
       sky},
      {"noise",
       "noise(x, y, z, {octaves = 1})",
       "a smooth irregular number in -1 … 1 that varies over about one unit; a sum of sines, the same in "
       "float and "
       "in double",
       {{"octaves", "1 … 8", "1", "each adds detail half as large and half as strong"}},
       noise},
  };
  return library;
}

}  // namespace sdf
