// Scripts that mean harm, or only never end: each must come back with an error, soon, and with nothing
// gained.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "script/run.h"

namespace sdf {
namespace sandbox_test {

ScriptOptions fewInstructions() {
  ScriptOptions options;
  options.instructionLimit = 1'000'000;
  return options;
}

ScriptOptions littleMemory() {
  ScriptOptions options;
  options.memoryLimit = 16u << 20;
  return options;
}

const std::string kTooMany =
    "scene.lua:1: ran more than 1 million instructions; look for an endless loop near line 1";
const std::string kTooMuch = "needed more than 16 MiB of memory; look for what grows without end";

TEST(Sandbox, EndlessLoopsEnd) {
  for (const char* text : {
           "while true do end",
           "local function f() return f() end f()",
           "repeat until false",
           "for i = 1, math.huge do end",
           "goto again ::again:: goto again",
           "local t = setmetatable({}, {__index = function(t, k) return t[k + 1] end}) for i = 1, 1e9 do "
           "pcall(function() "
           "return t[1] end) end",
           "table.sort({3, 2, 1}, function(a, b) while true do end end)",
           "field(function(x) while true do end end)",
           "sphere(1):paint{color = function() while true do end end}",
           "tostring(setmetatable({}, {__tostring = function() while true do end end}))",
       })
    EXPECT_TRUE(errorOf(text, fewInstructions()).find("ran more than 1 million instructions") !=
                std::string::npos)
        << text;
}

TEST(Sandbox, TheMessageNamesTheLineOfTheLoop) {
  EXPECT_EQ(errorOf("local n = 0\n\nwhile true do n = n + 1 end", fewInstructions()),
            "scene.lua:3: ran more than 1 million instructions; look for an endless loop near line 3");
}

// Work on it grows as the square of its length, and what compiles it for a graphics card goes down by
// recursion.
TEST(Sandbox, ChainsOfOperatorsHaveAnEnd) {
  const std::string most =
      "scene.lua:2: the shape has 4097 operations upon one another, and up to 4096 can be drawn "
      "and meshed; give all shapes to one union(list), intersection or difference, and each "
      "operator once";
  for (const char* one : {"s:round(1e-6)", "s - sphere(0.01)", "s & sphere(9)"})
    EXPECT_EQ(errorOf("local s = box(1)\nfor i = 1, 100000 do s = " + std::string(one) + " end return s"),
              most)
        << one;
  EXPECT_EQ(errorOf("return field(function(x)\nfor i = 1, 100000 do x = sin(x) end return x end)"),
            "scene.lua:2: the formula has 4097 operations upon one another, and up to 4096 can be drawn and "
            "meshed; "
            "look for a loop that can be shorter");
  sceneOf("local s = box(1) for i = 1, 40 do s = s:round(1e-6) - sphere(0.01) end return s");
}

// However many, given at once they stand side by side.
TEST(Sandbox, ListsOfShapesAreNoChains) {
  sceneOf(
      "local all = {} for i = 1, 10000 do all[i] = sphere(0.1):translate(i, 0, 0) end "
      "return union(all), difference(box(1), union(all))");
}

// Names are looked up, not gone through: the square of so many would be 20,000,000,000 comparisons.
TEST(Sandbox, ManyPartsTakeTheirNumberOnly) {
  const Scene named = sceneOf(
      "local s = sphere(1) for i = 1, 100000 do part('a long name that all parts share ' .. i, s) end");
  EXPECT_EQ(named.parts.size(), 100'000u);
  EXPECT_EQ(errorOf("part('part 2', sphere(1)) part('part 2', sphere(2))"),
            "scene.lua:1: part 'part 2' exists already; give each part a name of its own");
  const Scene returned = sceneOf("part('part 2', sphere(1)) return sphere(1), sphere(2)");
  ASSERT_EQ(returned.parts.size(), 3u);
  EXPECT_EQ(returned.parts[1].name, "part 3");
  EXPECT_EQ(returned.parts[2].name, "part 4");
}

TEST(Sandbox, AFileOfGigabytesIsNotRead) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "sparse.lua";
  std::ofstream(file) << "return sphere(1)";
  std::filesystem::resize_file(file, std::uintmax_t{4} << 30);
  const Result<Scene> scene = loadScene(file);
  std::filesystem::remove(file);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message,
            file.string() + ": it has 4096 MiB, and a scene may use 256 MiB of memory; name a scene file");
}

TEST(Sandbox, ALimitCannotBeCaught) {
  for (const char* text : {
           "while true do pcall(function() while true do end end) end",
           "pcall(pcall, pcall, function() while true do end end) while true do end",
           "xpcall(function() while true do end end, function() while true do end end)",
           "xpcall(function() while true do end end, xpcall) while true do end",
           "local function f() pcall(f) while true do end end f()",
           "local a <close> = setmetatable({}, {__close = function() while true do end end}) while true do "
           "end",
           "pcall(error, setmetatable({}, {__tostring = function() while true do end end})) while true do "
           "end",
           "pcall(function() while true do end end) return sphere(1)",
           "pcall(table.sort, {3, 2, 1}, function() while true do end end) return sphere(1)",
       })
    EXPECT_EQ(errorOf(text, fewInstructions()), kTooMany) << text;
}

TEST(Sandbox, MemoryIsBounded) {
  for (const char* text : {
           "local t = {} while true do t[#t + 1] = {} end",
           "local s = 'x' while true do s = s .. s end",
           "local t = {} for i = 1, 1e9 do t[i] = i end",
           "local t = {} for i = 1, 1e9 do t[i] = 'text ' .. i end",
           "local t = {} for i = 1, 22 do t[i] = 'xxxxxxxxxxxxxxxx' end while true do t[1] = table.concat(t) "
           "t[2] = t[1] end",
           "local s = 'x' while true do s = string.format('%s%s', s, s) end",
           "local t = {} for i = 1, 1e9 do t[i] = function() return i end end",
       })
    EXPECT_EQ(errorOf(text, littleMemory()), "scene.lua:1: " + kTooMuch) << text;
}

TEST(Sandbox, AScriptMaySurviveTheRefusalOfMemory) {
  const Scene scene = sceneOf(
      "local ok, e = pcall(function() local s = 'x' while true do s = s .. s end end)"
      "assert(not ok) return sphere(1)",
      littleMemory());
  EXPECT_EQ(scene.parts.size(), 1u);
}

TEST(Sandbox, GraphsCountAsMemory) {
  // Each of these holds little in Lua itself.
  for (const char* text : {
           "local s = sphere(1) for i = 1, 100 do s = s | s:translate(i, 0, 0) end return s",
           "local s = sphere(1) for i = 1, 40 do s = union{s, s} end return s",
           "local s = sphere(1) for i = 1, 12 do s = union{s, s} end local t = {} for i = 1, 1e9 do t[i] = "
           "s:paint{color = {1, 0, 0}} end return s",
           "local e = {} for i = 1, 1e9 do e[i] = sin(i * time) * time end return sphere(e[1])",
           "local function f(x, n) local all = {} for i = 1, n do all[i] = sin(x * i) + cos(x) end return "
           "all[1] end "
           "field(function(x) return f(x, 1e9) end)",
       }) {
    const std::string message = errorOf(text, littleMemory());
    EXPECT_TRUE(message.find("16 MiB of memory") != std::string::npos) << message << "\n" << text;
    EXPECT_TRUE(message.starts_with("scene.lua:1: ")) << message << "\n" << text;
  }
}

TEST(Sandbox, GraphsThatAreDroppedCostNothing) {
  ScriptOptions options = littleMemory();
  const Scene scene = sceneOf("for i = 1, 3e5 do local e = sin(time + i) end return sphere(1)", options);
  EXPECT_EQ(scene.parts.size(), 1u);
}

TEST(Sandbox, ALoopOfTheLibraryIsBounded) {
  const std::string most = "scene.lua:1: table.move moves up to 10 million values at a time; move fewer";
  for (const char* ends :
       {"1, math.maxinteger - 1, 2", "math.mininteger, math.maxinteger, 1", "1, 1e7 + 1, 2"})
    EXPECT_EQ(errorOf("table.move({}, " + std::string(ends) + ")", {}), most) << ends;
  EXPECT_EQ(errorOf("table.move(1, 1, 2, 2)", {}),
            "scene.lua:1: bad argument #1 to 'move' (table expected, got number)");
  EXPECT_EQ(errorOf("table.move({}, 'a', 2, 2)", {}),
            "scene.lua:1: bad argument #2 to 'move' (number expected, got string)");
  EXPECT_EQ(sceneOf("local t = table.move({1, 2, 3}, 2, 3, 1) return sphere(t[1])", {}).parts.size(), 1u);
}

TEST(Sandbox, WorkThatFewInstructionsAskForIsBoundedByTime) {
  ScriptOptions options;
  options.timeLimit = 0.2;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(errorOf("local t = {} for i = 1, 1e5 do t[i] = i end\nwhile true do table.insert(t, 1, 1) end",
                    options),
            "scene.lua:2: ran longer than 0.2 seconds; look for a loop near line 2");
  EXPECT_EQ(
      errorOf(
          "local t = {} for i = 1, 1e5 do t[i] = i end\nwhile true do pcall(table.move, t, 1, 1e5, 2) end",
          options),
      "scene.lua:2: ran longer than 0.2 seconds; look for a loop near line 2");
  // The clock is read every thousand instructions, some two hundred of these copies of a tenth of a
  // millisecond.
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  EXPECT_LT(passed.count(), 20.0);
}

TEST(Sandbox, DeepRecursionEndsCleanly) {
  const std::string advice = "look for a function that calls itself without end";
  for (const char* text : {
           "local function f() return 1 + f() end f()",
           "local function f() return field(function() return f() end) end f()",
           "local function f(...) return f(1, ...) + 1 end f()",
           "local t = setmetatable({}, {}) getmetatable(t).__index = function(t, k) return t[k] + 1 end "
           "return t.x",
           "local function f() local ok, e = pcall(f) error(e, 0) end f()",
       }) {
    const std::string message = errorOf(text);
    EXPECT_TRUE(message.find("overflow") != std::string::npos) << message << "\n" << text;
  }
  EXPECT_EQ(errorOf("local function f() return 1 + f() end f()"), "scene.lua:1: stack overflow; " + advice);
  std::string nested = "return " + std::string(100'000, '(') + "1" + std::string(100'000, ')');
  EXPECT_TRUE(errorOf(nested).find("overflow") != std::string::npos);
}

TEST(Sandbox, WhatReachesOutsideDoesNotExist) {
  for (const char* name : {"io", "os", "require", "load", "loadfile", "dofile", "package", "coroutine",
                           "debug", "collectgarbage", "warn", "unpack", "loadstring"})
    EXPECT_EQ(errorOf(std::string("local a = ") + name),
              std::string("scene.lua:1: unknown name '") + name +
                  "'; a scene cannot reach files, the system or other code");
  for (const char* name : {"string.find", "string.match", "string.gmatch", "string.gsub", "string.rep",
                           "string.dump", "string.pack"})
    EXPECT_NE(errorOf(std::string("local a = ") + name).find("unknown name"), std::string::npos) << name;
  EXPECT_EQ(errorOf("local a = next"), "scene.lua:1: unknown name 'next'; go through a table with pairs");
  EXPECT_EQ(errorOf("local a = _G"),
            "scene.lua:1: unknown name '_G'; define it above, or see the scene language");
}

// Only what is listed here can be named; whatever else a later Lua brings stays out.
TEST(Sandbox, NothingButTheLanguageCanBeNamed) {
  sceneOf(R"(
    local allowed = {}
    for _, t in ipairs{
      {'assert', 'error', 'ipairs', 'pairs', 'pcall', 'print', 'rawequal', 'rawget', 'rawlen', 'rawset', 'select',
       'setmetatable', 'getmetatable', 'tonumber', 'tostring', 'type', 'xpcall', 'math', 'table', 'string', 'pi'},
      {'material', 'param', 'part', 'paint', 'camera', 'directional_light', 'point_light', 'ambient', 'background', 'fog',
       'shadows', 'ambient_occlusion', 'reflections', 'max_distance', 'gamma', 'bounds', 'field', 'value'},
      {'color', 'checkerboard', 'gradient', 'vertical_gradient', 'sky', 'noise'},
      {'sin', 'cos', 'tan', 'asin', 'acos', 'atan', 'exp', 'log', 'sqrt', 'square', 'pow', 'abs', 'sign', 'floor', 'ceil',
       'round', 'fract', 'mod', 'min', 'max', 'clamp', 'mix', 'step', 'smoothstep', 'less', 'less_equal', 'equal',
       'length', 'dot'},
    } do for _, name in ipairs(t) do allowed[name] = true end end
    for name in pairs(_ENV) do
      local shape = rawget(_ENV, name)
      assert(allowed[name] or type(shape) == 'function', name)
    end
    for _, name in ipairs{'byte', 'char', 'format', 'len', 'lower', 'reverse', 'sub', 'upper'} do allowed[name] = true end
    for name in pairs(string) do assert(allowed[name], name) end
    return sphere(1))");
}

TEST(Sandbox, MetatablesOfTheLanguageAreOutOfReach) {
  sceneOf(R"(
    for _, v in ipairs{sphere(1), time, material{}, '', _ENV, math, string} do assert(getmetatable(v) == false) end
    for _, v in ipairs{_ENV, math, string, table} do assert(not pcall(setmetatable, v, {})) end
    assert(not pcall(setmetatable, sphere(1), {}))
    assert(not pcall(function() sphere(1).x = 1 end))
    assert(not pcall(function() return time() end))
    return sphere(1))");
  EXPECT_EQ(errorOf("getmetatable('').__index = 1"), "scene.lua:1: attempt to index a boolean value");
}

// Finalizers run where instructions are not counted.
TEST(Sandbox, FinalizersAreRefused) {
  const std::string message = "scene.lua:1: setmetatable: scenes cannot have finalizers; remove __gc";
  EXPECT_EQ(errorOf("setmetatable({}, {__gc = function() while true do end end})"), message);
  EXPECT_EQ(errorOf("setmetatable({}, {__gc = true})"), message);
  // Set later, it has no effect.
  sceneOf(
      "local m = {} local t = setmetatable({}, m) m.__gc = function() while true do end end t = nil "
      "local junk = {} for i = 1, 1e5 do junk = {junk} end return sphere(1)");
}

TEST(Sandbox, ScriptsDoNotSeeEachOther) {
  sceneOf("leak = 1 string.leak = 1 math.sin = nil return sphere(1)");
  EXPECT_NE(errorOf("return leak").find("unknown name 'leak'"), std::string::npos);
  EXPECT_NE(errorOf("return string.leak").find("unknown name 'string.leak'"), std::string::npos);
  EXPECT_EQ(numberOf("math.sin(0)"), 0.0);
}

TEST(Sandbox, TooLittleMemoryToStartIsSaidSo) {
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{100}, std::size_t{5'000}}) {
    ScriptOptions options;
    options.memoryLimit = bytes;
    EXPECT_NE(errorOf("return sphere(1)", options).find("MiB of memory"), std::string::npos) << bytes;
  }
}

}  // namespace sandbox_test
}  // namespace sdf
