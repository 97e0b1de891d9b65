// Every mistake gets one line: where, what, and what would be right.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "script/run.h"

namespace sdf {
namespace errors_test {

struct Mistake {
  const char* text;
  const char* message;
};

void expectMessages(std::initializer_list<Mistake> mistakes) {
  for (const auto& [text, message] : mistakes) EXPECT_EQ(errorOf(text), message) << text;
}

TEST(Errors, SyntaxErrorsNameLineAndReason) {
  expectMessages({{"x = = 3", "scene.lua:1: unexpected symbol near '='"},
                  {"\nlocal t = {1, 2\nreturn sphere(1)",
                   "scene.lua:3: '}' expected (to close '{' at line 2) near 'return'"},
                  {"return sphere(1", "scene.lua:1: ')' expected near <eof>"},
                  {"s = \"open", "scene.lua:1: unfinished string near <eof>"}});
}

// A zero ends strings in C, not in Lua: what follows it counts.
TEST(Errors, NamesHoldNoControlCharacters) {
  expectMessages({
      {R"(part("a\0b", sphere(1)))",
       R"(scene.lua:1: part: the name must be without control characters, got "a\0b")"},
      {R"(part("a\27[2J", sphere(1)))",
       R"(scene.lua:1: part: the name must be without control characters, got "a\27[2J")"},
      {R"(param("k\0", 1))", R"(scene.lua:1: param: the name must be without control characters, got "k\0")"},
      {R"(param("k\n=", 1))",
       R"(scene.lua:1: param: the name must be without control characters, got "k\10=")"},
      {R"(material{name = "red\0"})",
       R"(scene.lua:1: material: 'name' must be without control characters, got "red\0")"},
      {R"(return mesh("a.obj\0.txt"))",
       R"(scene.lua:1: mesh: the file must be without control characters, got "a.obj\0.txt")"},
  });
}

TEST(Errors, WordsCountToTheirEnd) {
  expectMessages({
      {R"(tone("filmic\0"))",
       R"(scene.lua:1: tone must be one of "linear" or "filmic", got a string "filmic\0")"},
      {R"(return sphere{["radius\0"] = 1})",
       "scene.lua:1: sphere: unknown field 'radius '; did you mean 'radius'?"},
      {R"(return sphere(1):paint("#fff\0"))",
       R"(scene.lua:1: paint: the material or its colour must be a colour like "#ff8800", got "#fff\0")"},
      {R"(error("a\0b"))", "scene.lua:1: a b"},
      {R"(return sphere("1\0"))", R"(scene.lua:1: sphere: 'radius' must be a number, got a string "1\0")"},
      {R"(local t = {["k\0b"] = 1, ["k\0a"] = 2} local s = "" for k, v in pairs(t) do s = s .. v end error(s))",
       "scene.lua:1: 21"},
  });
}

TEST(Errors, UnknownNamesComeWithTheNearestOne) {
  expectMessages({
      {"\n\nreturn spere(1)", "scene.lua:3: unknown name 'spere'; did you mean 'sphere'?"},
      {"return shpere(1)", "scene.lua:1: unknown name 'shpere'; did you mean 'sphere'?"},
      {"local a = tiem", "scene.lua:1: unknown name 'tiem'; did you mean 'time'?"},
      {"ball_size = 1 return sphere(bal_size)",
       "scene.lua:1: unknown name 'bal_size'; did you mean 'ball_size'?"},
      {"return qqqq", "scene.lua:1: unknown name 'qqqq'; define it above, or see the scene language"},
      {"return sphere(1):trnslate(1)", "scene.lua:1: a shape has no 'trnslate'; did you mean 'translate'?"},
      {"return sphere(1):repeat_polar(3)",
       "scene.lua:1: a shape has no 'repeat_polar'; did you mean 'polar_repeat'?"},
      {"return sphere(1).radius", "scene.lua:1: a shape has no 'radius'"},
      {"return math.flor(1)", "scene.lua:1: unknown name 'math.flor'; did you mean 'math.floor'?"},
      {"return ('x'):rep(3)", "scene.lua:1: unknown name 'string.rep'; scenes have no such function"},
      {"return time.now", "scene.lua:1: a formula has no field 'now'; it is one value"},
  });
}

TEST(Errors, UnknownFieldsComeWithTheNearestOne) {
  expectMessages({
      {"return sphere{radus = 1}", "scene.lua:1: sphere: unknown field 'radus'; did you mean 'radius'?"},
      {"return sphere{size = 1}", "scene.lua:1: sphere: unknown field 'size'; it takes radius"},
      {"return union{sphere(1), kk = 1}", "scene.lua:1: union: unknown field 'kk'; did you mean 'k'?"},
      {"camera{form = {1, 2, 3}}", "scene.lua:1: camera: unknown field 'form'; did you mean 'from'?"},
      {"camera{zoom = 1}",
       "scene.lua:1: camera: unknown field 'zoom'; it takes from, to, up, fov, mirrored, aperture and focus"},
      {"return sphere(1):paint{colour = 1}",
       "scene.lua:1: material: unknown field 'colour'; did you mean 'color'?"},
      {"local k = param('k', 1, {mim = 0})", "scene.lua:1: param: unknown field 'mim'; did you mean 'min'?"},
  });
}

TEST(Errors, WrongTypesSayWhatWasGiven) {
  expectMessages({
      {"return sphere('big')", "scene.lua:1: sphere: 'radius' must be a number, got a string \"big\""},
      {"return sphere('3')", "scene.lua:1: sphere: 'radius' must be a number, got a string \"3\""},
      {"return sphere{radius = true}", "scene.lua:1: sphere: 'radius' must be a number, got true"},
      {"return sphere(sphere(1))", "scene.lua:1: sphere: 'radius' must be a number, got a shape"},
      {"return sphere(print)", "scene.lua:1: sphere: 'radius' must be a number, got a function"},
      {"return box('x')", "scene.lua:1: box: 'half' must be {x, y, z} or a number, got a string \"x\""},
      {"return box{half = {1, 2}}",
       "scene.lua:1: box: 'half' must be {x, y, z} or a number, got a table of 2 values"},
      {"return box{half = {1, 'a', 3}}",
       "scene.lua:1: number 2 of box: 'half' must be a number, got a string \"a\""},
      {"return sphere(1):mirror('w')",
       "scene.lua:1: mirror: 'axis' must be one of \"x\", \"y\" or \"z\", got a string \"w\""},
      {"return star(2.5)", "scene.lua:1: star: 'points' must be a whole number, got the number 2.5"},
      {"return star(param('n', 5))",
       "scene.lua:1: star: 'points' must be a plain number, got a formula; value(e) gives its present value"},
      {"return translate(1, 2, 3)",
       "scene.lua:1: translate: 'shape' must be a shape, got the number 1; write translate(shape, offset) or "
       "shape:translate(…)"},
      {"return union(sphere(1), 'x')", "scene.lua:1: union: 'k' must be a number, got a string \"x\""},
      {"return union{shapes = {sphere(1), 3}}",
       "scene.lua:1: union: 'shapes' must be a shape, got the number 3"},
      {"return polygon('x')",
       "scene.lua:1: polygon: 'points' must be a list of points {{x, y}, …}, got a string \"x\""},
      {"return sphere(1) | 3", "scene.lua:1: '|' needs a shape on both sides, got the number 3"},
      {"return sphere(1) + sphere(2)",
       "scene.lua:1: shapes are combined with | (union), & (intersection), - (difference) and ~ (xor); moved "
       "with "
       "translate, sized with scale"},
      {"return sphere(1)(1)",
       "scene.lua:1: a shape that is called gives its distance at a place; write shape(x, y, z), got 1 "
       "argument"},
      {"return circle(1)(1, 2, 3)",
       "scene.lua:1: a shape that is called gives its distance at a place; write shape(x, y), got 3 "
       "arguments"},
      {"return sphere(1)(1, 'a', 3)",
       "scene.lua:1: shape(x, y, z): 'y' must be a number, got a string \"a\""},
      {"return sphere(1)({1, 2})", "scene.lua:1: shape(x, y, z) must be {x, y, z}, got a table of 2 values"},
      {"return time + {}", "scene.lua:1: '+' needs a number or a formula on both sides, got a table"},
      {"return sin('x')", "scene.lua:1: sin: argument 1 must be a number, got a string \"x\""},
      {"camera{mirrored = 1}", "scene.lua:1: camera: 'mirrored' must be true or false, got the number 1"},
      {"camera(3)",
       "scene.lua:1: camera takes a table of named fields, got the number 3; write "
       "camera{from = {3.4, 2.6, 4.6}, to = {0, 0, 0}}"},
      {"camera{{1, 2, 3}}",
       "scene.lua:1: camera: every field needs a name; write camera{from = {3.4, 2.6, 4.6}, to = {0, 0, 0}}"},
      {"part(sphere(1), 'a')", "scene.lua:1: part: the name must be a text, got a shape"},
      {"part('a', 3)", "scene.lua:1: part: the second argument must be a shape, got the number 3"},
      {"return sphere(1):paint{color = '#ff000'}",
       "scene.lua:1: material: 'color' must be a colour like \"#ff8800\", got \"#ff000\""},
      {"return sphere(1):paint{color = sphere(1)}",
       "scene.lua:1: material: 'color' must be a colour (a number, {r, g, b}, \"#rrggbb\" or a function of "
       "x, y, z), got "
       "a shape"},
      {"return sphere(1):paint{color = function() return 1, 2 end}",
       "scene.lua:1: material: 'color' must return r, g, b or one colour, returned 2 values"},
      {"return sphere(1):paint{shininess = function() return 'x' end}",
       "scene.lua:1: the result of material: 'shininess' must be a number, got a string \"x\""},
      {"return field(3, 4)",
       "scene.lua:1: field takes a table of named fields, got the number 4; write "
       "field(function(x, y, z) return … end, {bounds = {{x0, y0, z0}, {x1, y1, z1}}, lipschitz = "
       "2})"},
      {"return field('x')",
       "scene.lua:1: field: the formula must be a formula or a function of x, y, z, got a string "
       "\"x\""},
      {"return field(function() end)",
       "scene.lua:1: the result of field: the formula must be a number, got nothing"},
      {"return 3", "scene.lua: the script must return shapes, returned the number 3"},
  });
}

TEST(Errors, CountsOfArgumentsAreChecked) {
  expectMessages({
      {"return sphere(1, 2)",
       "scene.lua:1: sphere: too many arguments, the first one too many is the number 2; write "
       "sphere(radius)"},
      {"return sphere(1):translate()",
       "scene.lua:1: translate: 'offset' is missing; write translate(shape, offset)"},
      {"return sphere(1):translate(1, 2)",
       "scene.lua:1: translate: 'offset' takes three numbers, got two; the third is missing"},
      {"return circle(1):rotate(1, 2):extrude(1)",
       "scene.lua:1: rotate: 'angles' takes one number, for a flat shape turns about z only"},
      {"return box(1, 2)",
       "scene.lua:1: box: 'half' takes three numbers or one for all, got two; the third is missing"},
      {"return box{1, 2}",
       "scene.lua:1: box: 'half' takes three numbers or one for all, got two; the third is missing"},
      {"return capsule(1, 2, 3, 4, 5)",
       "scene.lua:1: capsule: 'to' takes three numbers, got two; the third is missing"},
      {"return sphere(1):rotate_about(0, 1, 0)",
       "scene.lua:1: rotate_about: 'angle' is missing; write rotate_about(shape, axis, angle)"},
      {"return box(1, 2, 3, 4)",
       "scene.lua:1: box: too many arguments, the first one too many is the number 4; write box(half)"},
      {"return sphere{1, radius = 2}", "scene.lua:1: sphere: 'radius' is given twice, by place and by name"},
      {"return union()", "scene.lua:1: union: 'shapes' is missing; write union(shapes, k, blend)"},
      {"return sin(1, 2)", "scene.lua:1: sin: too many arguments; write sin(a)"},
      {"return mix(1, 2)", "scene.lua:1: mix: too few arguments; write mix(a, b, t)"},
      {"return select(1, 2)",
       "scene.lua:1: select takes a condition and two values, select(less(x, 0), a, b); the n-th "
       "of ... is ({...})[n]"},
  });
}

TEST(Errors, OneNumberIsNoPlaceAndNoDirection) {
  const std::string three = " must be {x, y, z}, got the number 2; write {2, 0, 0}, {0, 2, 0} or {0, 0, 2}";
  for (const auto& [text, what] : std::initializer_list<Mistake>{
           {"return sphere(1):translate(2)", "translate: 'offset'"},
           {"return sphere(1):rotate(2)", "rotate: 'angles'"},
           {"return sphere(1):rotate{angles = 2}", "rotate: 'angles'"},
           {"return sphere(1):rotate_about(2, {angle = 90})", "rotate_about: 'axis'"},
           {"return sphere(1):mirror{normal = 2}", "mirror: 'normal'"},
           {"return capsule{from = 2}", "capsule: 'from'"},
           {"return plane(2)", "plane: 'normal'"},
           {"camera{from = 2}", "camera: 'from'"},
           {"directional_light{direction = 2}", "directional_light: 'direction'"},
           {"gradient(2, 0, 1)", "gradient: the axis"},
           {"dot(2, {1, 2, 3})", "dot: argument 1"}})
    EXPECT_EQ(errorOf(text), "scene.lua:1: " + (what + three)) << text;
  expectMessages({
      {"return sphere(1):rotate(param('k', 90))",
       "scene.lua:1: rotate: 'angles' must be {x, y, z}, got a formula; write {k, 0, 0}, {0, k, 0} or {0, 0, "
       "k}"},
      {"return segment{from = -0.5}",
       "scene.lua:1: segment: 'from' must be {x, y}, got the number -0.5; write {-0.5, 0} or {0, -0.5}"},
  });
}

TEST(Errors, NamedVectorsNameEveryComponent) {
  expectMessages({
      {"return box{half = {x = 1, y = 2}}", "scene.lua:1: z of box: 'half' must be a number, got nothing"},
      {"return box{half = {1, y = 2, z = 3}}",
       "scene.lua:1: box: 'half': every field needs a name; write {x = 1, y = 2, z = 3}"},
      {"return sphere(1):translate{1, y = 2, z = 3}",
       "scene.lua:1: translate: 'offset': every field needs a name; write {x = 1, y = 2, z = 3}"},
      {"return sphere(1):translate{x = 1, y = 2, z = 3, w = 4}",
       "scene.lua:1: translate: 'offset': unknown field 'w'; it takes x, y and z"},
      {"return rectangle{half = {x = 1, y = 2, z = 3}}",
       "scene.lua:1: rectangle: 'half': unknown field 'z'; it takes x and y"},
      {"return sphere(1):translate{x = 1, y = 'b', z = 3}",
       "scene.lua:1: y of translate: 'offset' must be a number, got a string \"b\""},
  });
}

TEST(Errors, ValuesThatMakeNoSenseAreRefused) {
  expectMessages({
      {"return sphere(-1)", "scene.lua:1: sphere: radius must be positive, got -1"},
      {"return union{sphere(1), box(1), k = 0}", "scene.lua:1: union: k must be positive, got 0"},
      {"return union{sphere(1), box(1), k = -0.5}", "scene.lua:1: union: k must be positive, got -0.5"},
      {"return sphere(0 / 0)",
       "scene.lua:1: sphere: 'radius' must be a finite number, got NaN, which is not a number"},
      {"return sphere(math.huge)", "scene.lua:1: sphere: 'radius' must be a finite number, got infinity"},
      {"return sphere(1 / time)", "scene.lua:1: sphere: 'radius' must be a finite number, got infinity"},
      {"local k = param('k', 0 / 0)",
       "scene.lua:1: param 'k': the default must be a finite number, got NaN, which is not a number"},
      {"local k = param('k', 2, {max = 1})", "scene.lua:1: param 'k': the default 2 is outside 0 … 1"},
      {"local k = param('', 2)", "scene.lua:1: param: the name must be a word without '=', got \"\""},
      {"local k = param('time', 2)",
       "scene.lua:1: param: 'time' is the scene's clock; give the parameter another name"},
      {"camera{fov = 0}", "scene.lua:1: camera: 'fov' must be positive, got 0"},
      {"camera{aperture = -1}", "scene.lua:1: camera: 'aperture' must be 0 or more, got -1"},
      {"camera{focus = 0}", "scene.lua:1: camera: 'focus' must be positive, got 0"},
      {"camera{fov = 180}", "scene.lua:1: camera: 'fov' must be below 180 degrees"},
      {"camera{from = {1, 1, 1}, to = {1, 1, 1}}",
       "scene.lua:1: camera: 'from' and 'to' must be different points"},
      {"directional_light{direction = {0, 0, 0}}",
       "scene.lua:1: directional_light: 'direction' must not be {0, 0, 0}"},
      {"point_light{radius = -1}", "scene.lua:1: point_light: 'radius' must be 0 or more, got -1"},
      {"directional_light{radius = 90}", "scene.lua:1: directional_light: 'radius' must be below 90 degrees"},
      {"background_light(-1)", "scene.lua:1: background_light must be 0 or more, got -1"},
      {"background_light('sky')", "scene.lua:1: background_light must be a number, got a string \"sky\""},
      {"shadows{steps = 0}", "scene.lua:1: shadows: 'steps' must be 1 or more, got 0"},
      {"shadows{kind = 'sharp'}",
       "scene.lua:1: shadows: 'kind' must be one of \"none\", \"hard\", \"soft\", "
       "\"improved\" or \"signed\", got a string \"sharp\""},
      {"tone('bright')",
       "scene.lua:1: tone must be one of \"linear\" or \"filmic\", got a string \"bright\""},
      {"gamma(0)", "scene.lua:1: gamma must be positive, got 0"},
      {"max_distance(1e20)", "scene.lua:1: max_distance must be at most 1e15, got 1e+20"},
      {"bounds({1, 1, 1}, {0, 2, 2})",
       "scene.lua:1: bounds must have its first corner below the second on every axis"},
      {"return sphere(1):paint{shininess = 0}", "scene.lua:1: material: 'shininess' must be positive, got 0"},
      {"return sphere(1):paint(noise(0, 0, 0, {octaves = 9}))",
       "scene.lua:1: noise: 'octaves' must be 8 or less, got 9"},
      {"return sphere(1):paint(gradient_noise(0, 0, 0, {octaves = 9}))",
       "scene.lua:1: gradient_noise: 'octaves' must be 8 or less, got 9"},
      {"return sphere(1):paint(value_noise(0, 0, 0, {seed = -1}))",
       "scene.lua:1: value_noise: 'seed' must be 0 or more, got -1"},
      {"return sphere(1):paint(value_noise(0, 0, 0, {seed = 2e9}))",
       "scene.lua:1: value_noise: 'seed' must be a whole number from -1e9 to 1e9, got the number "
       "2000000000.0"},
      {"return sphere(1):paint(cell_noise(0, 0, 0, {kind = 'third'}))",
       "scene.lua:1: cell_noise: 'kind' must be one of \"nearest\", \"second\" or \"border\", got a string "
       "\"third\""},
      {"return field(function() return 0 / 0 end)",
       "scene.lua:1: the result of field: the formula must be a finite "
       "number, got NaN, which is not a number"},
      {"return mod(1, 0)", "scene.lua:1: mod: the second argument must not be 0"},
  });
}

TEST(Errors, PositionsHaveNoPlaceInSizesAndCameras) {
  expectMessages({
      {"return field(function(x) return sphere(x) end)",
       "scene.lua:1: sphere: 'radius' must not depend on the position; it is one number for the whole scene"},
      {"field(function(x) camera{fov = x} return x end)",
       "scene.lua:1: camera: 'fov' must not depend on the position; it is one number for the whole scene"},
      {"ambient(function(x) return x end)",
       "scene.lua:1: ambient must not depend on the position; give a plain colour"},
      {"ambient(checkerboard(0, 1))",
       "scene.lua:1: number 1 of ambient must not depend on the position; it is one number for the whole "
       "scene"},
      {"field(function(x) return value(x) end)",
       "scene.lua:1: value: the formula depends on the position, so it has no single value"},
  });
}

TEST(Errors, ComparingFormulasPointsToTheirValues) {
  const std::string expected =
      "scene.lua:2: a formula cannot be compared, for its value may change; write value(k) for the present "
      "value of a parameter k, or choose with select(less(a, b), x, y)";
  for (const char* text : {"if time < 1 then end", "if 1 <= time then end", "if time == time + 1 then end",
                           "if param('a', 1) > time then end", "table.sort({time, 2 * time})",
                           "if param('k', 0.2) > 0.5 then end"})
    for (const bool fixed : {false, true})
      EXPECT_EQ(errorOf(std::string("\n") + text, {.fixed = fixed}), expected) << text << fixed;
}

TEST(Errors, FormulasInPlaceOfNumbersPointToTheirValues) {
  const std::string hint = "; value(k) gives the present value of a parameter k";
  for (const auto& [text, message] : std::initializer_list<Mistake>{
           {"for i = 1, k do end", "bad 'for' limit (number expected, got formula)"},
           {"local s = 'ball ' .. k", "attempt to concatenate a formula value (local 'k')"},
           {"local s = k & 3", "attempt to perform bitwise operation on a formula value (local 'k')"},
           {"local s = #k", "attempt to get length of a formula value (local 'k')"},
           {"local s = string.format('%d', k)",
            "bad argument #2 to 'format' (number expected, got formula)"}})
    for (const bool fixed : {false, true})
      EXPECT_EQ(errorOf(std::string("local k = param('k', 1) ") + text, {.fixed = fixed}),
                "scene.lua:1: " + (message + hint))
          << text << fixed;
}

TEST(Errors, SettingsAreMadeOnce) {
  expectMessages(
      {{"camera{fov = 40}\n\ncamera{fov = 50}", "scene.lua:3: camera is already set on line 1; set it once"},
       {"gamma(1)\ngamma(1)", "scene.lua:2: gamma is already set on line 1; set it once"}});
}

TEST(Errors, PartsAreCheckedWhereTheyAreAdded) {
  expectMessages({
      {"part('a', sphere(1))\npart('a', box(1))",
       "scene.lua:2: part 'a' exists already; give each part a name of its own"},
      {"part('', sphere(1))", "scene.lua:1: part: the name must not be empty"},
      {"part('a', circle(1))", "scene.lua:1: part 'a' is flat; extrude or revolve it"},
      {"return circle(1)", "scene.lua: the shape that the script returns is flat; extrude or revolve it"},
      {"", "scene.lua: the scene is empty; add a shape with part(name, shape) or return one"},
      {"local s = sphere(1)",
       "scene.lua: the scene is empty; add a shape with part(name, shape) or return one"},
  });
}

TEST(Errors, OverridesMustFitTheScene) {
  const std::string text = "return sphere(param('r', 1) + param('k', 0.2))";
  ScriptOptions options;
  options.values = {{"q", 1.0}};
  EXPECT_EQ(errorOf(text, options), "scene.lua: -D q: the scene has no parameter 'q' (it has r, k)");
  EXPECT_EQ(errorOf("return sphere(1)", options),
            "scene.lua: -D q: the scene has no parameter 'q' (it has none)");
  options.values = {{"r", std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_EQ(errorOf(text, options), "scene.lua: -D r: the value must be a finite number");
  options.values = {{"r", -2.0}};
  EXPECT_EQ(errorOf(text, options), "scene.lua:1: sphere: radius must be positive, got -1.8");
  options.values = {{"time", 1.0}};
  EXPECT_EQ(errorOf(text, options), "scene.lua: -D time: set the scene's clock with --time");
  options.values = {};
  options.time = std::numeric_limits<double>::infinity();
  EXPECT_EQ(errorOf(text, options), "scene.lua: the time must be a finite number of seconds");
}

TEST(Errors, AParameterHasOneMeaning) {
  expectMessages(
      {{"local a = param('k', 1)\nlocal b = param('k', 0.5)",
        "scene.lua:2: param 'k' exists already with another default or range; use the same, or another name"},
       {"local a = param('k', 1)\nlocal b = param('k', 1, {max = 9})",
        "scene.lua:2: param 'k' exists already with another default or range; use the same, or another "
        "name"}});
}

TEST(Errors, TheScriptsOwnErrorsKeepTheirPlace) {
  expectMessages({
      {"\nerror('boo')", "scene.lua:2: boo"},
      {"\nerror('boo', 0)", "scene.lua:2: boo"},
      {"error{}", "scene.lua:1: error was given a table; give it a text"},
      {"error()", "scene.lua:1: error was given nothing; give it a text"},
      {"assert(false, 'two\\nlines')", "scene.lua:1: two lines"},
      {"local t = nil\nt.x = 1", "scene.lua:2: attempt to index a nil value (local 't')"},
      {"local f\nlocal function g() f() end\ng()", "scene.lua:2: attempt to call a nil value (upvalue 'f')"},
  });
}

// Texts of scripts are not to move a terminal's cursor, nor to fill it.
TEST(Errors, AreOneLineForATerminal) {
  expectMessages({{"error('\\27[31mred\\7\\127 \\9tab\\r\\nline')", "scene.lua:1:  [31mred    tab  line"}});
  const std::string longest = errorOf("local s = 'ä' for i = 1, 20 do s = s .. s end error(s)");
  EXPECT_LE(longest.size(), 2010u);
  EXPECT_TRUE(longest.ends_with("ä …")) << longest.substr(longest.size() - 8);
}

TEST(Errors, TheFileIsNamedAsItWasGiven) {
  const std::string lengthy = "some/folder/" + std::string(80, 'x') + ".lua";
  for (const std::string& name : {std::string("scene.lua"), std::string("../a b/scene.lua"), lengthy}) {
    for (const char* text : {"\nspere(1)", "\nx = = 1", "\nerror('a')", "\nlocal t = nil + 1"}) {
      const Result<Scene> scene = runScene(text, name);
      ASSERT_FALSE(scene);
      EXPECT_TRUE(scene.error().message.starts_with(name + ":2: ")) << scene.error().message;
    }
  }
}

TEST(Errors, FilesThatCannotBeReadAreFileErrors) {
  const Result<Scene> none = loadScene("/nowhere/scene.lua");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, ErrorKind::Files);
  EXPECT_EQ(none.error().message, "/nowhere/scene.lua: cannot be read; check the name and the permissions");
  const Result<Scene> folder = loadScene("/tmp");
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().message, "/tmp: this is a folder; name a scene file");
}

TEST(Errors, CompiledLuaIsRefused) {
  EXPECT_EQ(errorOf("\x1BLuaT"), "scene.lua: this is compiled Lua; give the scene's text");
}

TEST(Errors, AnEmptyFileIsAnEmptyScene) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "empty_scene.lua";
  std::ofstream{file};
  const Result<Scene> scene = loadScene(file);
  std::filesystem::remove(file);
  ASSERT_FALSE(scene);
  EXPECT_TRUE(scene.error().message.ends_with(
      "the scene is empty; add a shape with part(name, shape) or return one"));
}

}  // namespace errors_test
}  // namespace sdf
