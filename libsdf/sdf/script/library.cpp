#include "sdf/script/library.h"

#include <cmath>
#include <lua.hpp>

namespace sdf {

const FunctionInfo& runningFunction(lua_State* L) {
  return *static_cast<const FunctionInfo*>(lua_touserdata(L, lua_upvalueindex(1)));
}

void openLibrary(lua_State* L, const std::vector<FunctionInfo>& functions) {
  static const auto run = [](lua_State* state) { return callGuarded(state, runningFunction(state).call); };
  for (const FunctionInfo& f : functions) {
    lua_pushlightuserdata(L, const_cast<FunctionInfo*>(&f));
    lua_pushcclosure(L, run, 1);
    lua_setglobal(L, f.name.c_str());
  }
}

void expectArguments(lua_State* L, int least, int most) {
  const int count = lua_gettop(L);
  if (count >= least && count <= most) return;
  const FunctionInfo& f = runningFunction(L);
  raise(L, f.name + (count < least ? ": too few" : ": too many") + " arguments; write " + f.usage);
}

std::string usageOf(const CatalogEntry& entry) {
  std::string text = entry.name + "(";
  for (const Parameter& p : entry.parameters) text += (&p == &entry.parameters.front() ? "" : ", ") + p.name;
  return text + ")";
}

void checkNames(lua_State* L, int index, const std::string& function, const std::vector<std::string>& known,
                const std::string& usage) {
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    const bool named = lua_type(L, -2) == LUA_TSTRING;
    if (!named && !usage.empty()) raise(L, function + ": every field needs a name; write " + usage);
    const std::string name = named ? textAt(L, -2) : "";
    if (!named || std::ranges::find(known, name) != known.end()) continue;
    const std::string near = suggestion(name, known);
    raise(L, function + ": unknown field '" + name + "'" +
                 (near.empty() ? "; it takes " + listed(known) : near));
  }
}

namespace {

glm::dvec3 readCorner(lua_State* L, int index, const std::string& what) {
  if (!lua_istable(L, index))
    raise(L, what + " must be two corners {x0, y0, z0}, {x1, y1, z1}, got " + describe(L, index));
  return readPoint(L, index, what, 3);
}

}  // namespace

FieldValues readFields(lua_State* L, int index, const FunctionInfo& function) {
  if (lua_isnoneornil(L, index)) return {};
  if (!lua_istable(L, index))
    raise(L, function.name + " takes a table of named fields, got " + describe(L, index) + "; write " +
                 function.usage);
  std::vector<std::string> known;
  for (const SettingInfo& field : function.fields) known.push_back(field.name);
  checkNames(L, index, function.name, known, function.usage);
  FieldValues values;
  luaL_checkstack(L, 4, nullptr);
  for (const SettingInfo& field : function.fields) {
    const std::string what = function.name + ": '" + field.name + "'";
    if (lua_getfield(L, index, field.name.c_str()) != LUA_TNIL) {
      const SettingValue value = readSetting(L, lua_gettop(L), what, field);
      if (const std::string why = objection(field, value); !why.empty()) raise(L, what + " " + why);
      values[field.name] = value;
    }
    lua_pop(L, 1);
  }
  return values;
}

SettingValue readSetting(lua_State* L, int index, const std::string& what, const SettingInfo& field) {
  switch (field.kind) {
    case SettingKind::Flag:
      return readFlag(L, index, what);
    case SettingKind::Integer:
      return readInteger(L, index, what);
    case SettingKind::Choice:
      return readChoice(L, index, what, field.choices);
    case SettingKind::Text:
      return readText(L, index, what);
    case SettingKind::PlainNumber:
      return readPlainNumber(L, index, what);
    case SettingKind::Number:
      return readNumber(L, index, what, Depends::OnParameters);
    case SettingKind::SurfaceNumber:
      return readSurfaceNumber(L, index, what);
    case SettingKind::Vector:
      return readVector(L, index, what, 3, Depends::OnParameters);
    case SettingKind::Color:
      return readColor(L, index, what, Depends::OnParameters);
    case SettingKind::SurfaceColor:
      return readColor(L, index, what, Depends::OnPosition);
    case SettingKind::Box:
      break;
  }
  if (!lua_istable(L, index) || lua_rawlen(L, index) != 2)
    return Box{readCorner(L, index, what), readCorner(L, index + 1, what)};
  lua_rawgeti(L, index, 1);
  lua_rawgeti(L, index, 2);
  const Box box{readCorner(L, lua_gettop(L) - 1, what), readCorner(L, lua_gettop(L), what)};
  lua_pop(L, 2);
  return box;
}

}  // namespace sdf
