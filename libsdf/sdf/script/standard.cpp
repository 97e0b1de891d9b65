// What a script can name: Lua's base library, less what reaches outside or cannot be interrupted, and the
// scene language.
#include <algorithm>
#include <cstdio>
#include <lua.hpp>
#include <numbers>
#include <numeric>

#include "sdf/script/context.h"
#include "sdf/script/library.h"

namespace sdf {

namespace {

// Keys in an order that does not change from run to run: numbers, then texts, then the rest as they come.
int sortedPairs(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  lua_settop(L, 1);
  lua_newtable(L);
  lua_Integer count = 0;
  for (lua_pushnil(L); lua_next(L, 1); lua_pop(L, 1)) {
    lua_pushvalue(L, -2);
    lua_rawseti(L, 2, ++count);
  }
  std::vector<lua_Integer> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 1);
  const auto rank = [](int type) { return type == LUA_TNUMBER ? 0 : type == LUA_TSTRING ? 1 : 2; };
  std::stable_sort(order.begin(), order.end(), [&](lua_Integer a, lua_Integer b) {
    const int ra = rank(lua_rawgeti(L, 2, a)), rb = rank(lua_rawgeti(L, 2, b));
    bool before = ra < rb;
    if (ra == rb && ra == 0) before = lua_compare(L, -2, -1, LUA_OPLT);
    if (ra == rb && ra == 1) before = textAt(L, -2) < textAt(L, -1);
    lua_pop(L, 2);
    return before;
  });
  lua_createtable(L, static_cast<int>(count), 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    lua_rawgeti(L, 2, order[i]);
    lua_rawseti(L, 3, static_cast<lua_Integer>(i) + 1);
  }
  lua_pushinteger(L, 0);
  lua_pushcclosure(  // upvalues: the keys, how many are done
      L,
      [](lua_State* state) {
        lua_Integer i = lua_tointeger(state, lua_upvalueindex(2));
        for (;;) {
          lua_settop(state, 1);
          lua_pushinteger(state, ++i);
          lua_replace(state, lua_upvalueindex(2));
          if (lua_rawgeti(state, lua_upvalueindex(1), i) == LUA_TNIL) return 1;
          lua_pushvalue(state, -1);
          if (lua_rawget(state, 1) != LUA_TNIL) return 2;  // else removed on the way
        }
      },
      1 + 1);
  lua_pushvalue(L, 1);
  return 2;
}

int printToStderr(lua_State* L) {
  std::string line;
  for (int i = 1; i <= lua_gettop(L); ++i) {
    std::size_t size;
    const char* text = luaL_tolstring(L, i, &size);
    line.append(i > 1 ? "\t" : "").append(text, size);
    lua_pop(L, 1);
  }
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
  return 0;
}

// Lua calls the handler before it unwinds; after a limit's error that is inside of the hook, where
// instructions are not counted. Here the handler runs once the error has unwound.
int protectedCall(lua_State* L) {
  luaL_checkany(L, 2);
  lua_pushvalue(L, 1);
  lua_copy(L, 2, 1);
  lua_replace(L, 2);  // handler, function, arguments …
  const int status = lua_pcall(L, lua_gettop(L) - 2, LUA_MULTRET, 0);
  if (status == LUA_OK) {
    lua_pushboolean(L, true);
    lua_replace(L, 1);
    return lua_gettop(L);
  }
  lua_call(L, 1, LUA_MULTRET);
  lua_pushboolean(L, false);
  lua_insert(L, 1);
  return lua_gettop(L);
}

// Finalizers run outside of the instruction count.
int setTableMetatable(lua_State* L) {
  luaL_checktype(L, 1, LUA_TTABLE);
  if (!lua_isnil(L, 2)) luaL_checktype(L, 2, LUA_TTABLE);
  if (luaL_getmetafield(L, 1, "__metatable") != LUA_TNIL)
    raise(L, "setmetatable: this metatable is protected");
  lua_settop(L, 2);
  if (lua_istable(L, 2)) {
    lua_pushliteral(L, "__gc");
    if (lua_rawget(L, 2) != LUA_TNIL) raise(L, "setmetatable: scenes cannot have finalizers; remove __gc");
    lua_pop(L, 1);
  }
  lua_setmetatable(L, 1);
  return 1;
}

int getAnyMetatable(lua_State* L) {
  if (!lua_getmetatable(L, 1)) return lua_pushnil(L), 1;
  luaL_getmetafield(L, 1, "__metatable");
  return 1;
}

// Without an argument Lua would take the seed from the clock.
int seedRandom(lua_State* L) {
  if (lua_type(L, 1) != LUA_TNUMBER)
    raise(L, "math.randomseed needs a number, so that the scene is the same every time");
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_pushvalue(L, 1);
  lua_call(L, 1, 0);
  return 0;
}

// A loop in C, which no hook interrupts. The arguments are table.move's own to judge.
int moveSome(lua_State* L) {
  constexpr lua_Unsigned kMost = 10'000'000;  // some tenths of a second's worth
  int isFirst = 0, isLast = 0;
  const lua_Integer first = lua_tointegerx(L, 2, &isFirst), last = lua_tointegerx(L, 3, &isLast);
  if (isFirst && isLast && first <= last &&
      static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(first) >= kMost)
    raise(L, "table.move moves up to 10 million values at a time; move fewer");
  return lua_tocfunction(L, lua_upvalueindex(1))(L);
}

constexpr const char* kOutside[] = {"io",     "os",      "require",   "load",      "loadfile",
                                    "dofile", "package", "coroutine", "debug",     "collectgarbage",
                                    "warn",   "next",    "unpack",    "loadstring"};

// In order.
std::vector<std::string> textKeys(lua_State* L, int table) {
  std::vector<std::string> keys;
  for (lua_pushnil(L); lua_next(L, table); lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING) keys.push_back(textAt(L, -2));
  std::ranges::sort(keys);
  return keys;
}

std::string keyText(lua_State* L, int index) {
  return lua_type(L, index) == LUA_TSTRING ? textAt(L, index) : describe(L, index);
}

// `time` becomes a parameter of the scene when it is first named.
void pushTime(lua_State* L) {
  constexpr double kLongest = 3600.0;
  ScriptContext& c = contextOf(L);
  const ParameterInfo time{"time", c.options.time, 0.0, kLongest};
  c.scene.parameters.push_back(time);
  pushFormula(L, inputOf(c, time));
  lua_pushvalue(L, -1);
  lua_setglobal(L, "time");
}

int unknownGlobal(lua_State* L) {
  const std::string name = keyText(L, 2);
  if (name == "time") return pushTime(L), 1;
  if (name == "next") raise(L, "unknown name 'next'; go through a table with pairs");
  if (std::ranges::find(kOutside, name) != std::end(kOutside))
    raise(L, "unknown name '" + name + "'; a scene cannot reach files, the system or other code");
  std::vector<std::string> known = textKeys(L, 1);
  known.emplace_back("time");
  std::sort(known.begin(), known.end());
  const std::string near = suggestion(name, known);
  raise(L, "unknown name '" + name + "'" +
               (near.empty() ? "; define it above, or see the scene language" : near));
}

// For the tables of the standard library; upvalue: their name.
int unknownMember(lua_State* L) {
  const std::string library = textAt(L, lua_upvalueindex(1)), name = keyText(L, 2);
  lua_pushvalue(L, lua_upvalueindex(2));
  const std::string near = nearest(name, textKeys(L, lua_gettop(L)));
  raise(L,
        "unknown name '" + library + "." + name + "'; " +
            (near.empty() ? "scenes have no such function" : "did you mean '" + library + "." + near + "'?"));
}

// Makes the function on the top of the stack answer for what the table below it lacks, and pops both.
void answerForMissing(lua_State* L) {
  lua_newtable(L);
  lua_insert(L, -2);
  lua_setfield(L, -2, "__index");
  hideMetatable(L);
  lua_setmetatable(L, -2);
  lua_pop(L, 1);
}

void protectLibrary(lua_State* L, const char* name) {
  lua_getglobal(L, name);
  lua_pushstring(L, name);
  lua_pushvalue(L, -2);
  lua_pushcclosure(L, guarded<unknownMember>, 2);
  answerForMissing(L);
}

// Leaves only the named members of the table on the top of the stack.
void keepOnly(lua_State* L, const std::vector<std::string>& kept) {
  for (const std::string& key : textKeys(L, lua_gettop(L))) {
    if (std::ranges::find(kept, key) != kept.end()) continue;
    lua_pushnil(L);
    lua_setfield(L, -2, key.c_str());
  }
}

void openStandard(lua_State* L) {
  luaL_requiref(L, LUA_GNAME, luaopen_base, 1);
  keepOnly(L, {"assert", "error", "ipairs", "pcall", "rawequal", "rawget", "rawlen", "rawset", "tonumber",
               "tostring", "type"});
  luaL_requiref(L, LUA_TABLIBNAME, luaopen_table, 1);
  lua_getfield(L, -1, "move");
  lua_pushcclosure(L, guarded<moveSome>, 1);
  lua_setfield(L, -2, "move");
  luaL_requiref(L, LUA_STRLIBNAME, luaopen_string, 1);
  keepOnly(L, {"byte", "char", "format", "len", "lower", "reverse", "sub", "upper"});
  lua_pushliteral(L, "");
  lua_getmetatable(L, -1);
  hideMetatable(L);
  lua_pop(L, 2);
  luaL_requiref(L, LUA_MATHLIBNAME, luaopen_math, 1);
  lua_getfield(L, -1, "randomseed");
  lua_pushvalue(L, -1);
  lua_pushinteger(L, 0);
  lua_call(L, 1, 0);
  lua_pushcclosure(L, guarded<seedRandom>, 1);
  lua_setfield(L, -2, "randomseed");
  lua_pop(L, 4);
  const std::pair<const char*, lua_CFunction> own[] = {{"pairs", guarded<sortedPairs>},
                                                       {"print", guarded<printToStderr>},
                                                       {"xpcall", guarded<protectedCall>},
                                                       {"setmetatable", guarded<setTableMetatable>},
                                                       {"getmetatable", guarded<getAnyMetatable>}};
  for (const auto& [name, function] : own) lua_register(L, name, function);
}

// math.sin and the like take formulas too.
void shareWithMath(lua_State* L) {
  lua_getglobal(L, LUA_MATHLIBNAME);
  for (const FunctionInfo& f : formulaLibrary()) {
    const bool shared = lua_getfield(L, -1, f.name.c_str()) != LUA_TNIL;
    lua_pop(L, 1);
    if (!shared) continue;
    lua_getglobal(L, f.name.c_str());
    lua_setfield(L, -2, f.name.c_str());
  }
  lua_pop(L, 1);
}

}  // namespace

int openLanguage(lua_State* L) {
  openStandard(L);
  registerTypes(L);
  openFormulaOperators(L);
  openLibrary(L, formulaLibrary());
  openLibrary(L, patternLibrary());
  openLibrary(L, settingLibrary());
  openLibrary(L, shapeLibrary());
  shareWithMath(L);
  openCatalog(L);
  lua_pushnumber(L, std::numbers::pi);
  lua_setglobal(L, "pi");
  for (const char* library : {LUA_TABLIBNAME, LUA_STRLIBNAME, LUA_MATHLIBNAME}) protectLibrary(L, library);
  lua_pushglobaltable(L);
  lua_pushcfunction(L, guarded<unknownGlobal>);
  answerForMissing(L);
  return 0;
}

}  // namespace sdf
