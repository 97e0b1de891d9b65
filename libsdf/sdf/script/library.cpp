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

namespace {

std::vector<std::string> namesOf(const std::vector<FieldInfo>& fields) {
  std::vector<std::string> names;
  for (const FieldInfo& f : fields) names.push_back(f.name);
  return names;
}

}  // namespace

FieldReader::FieldReader(lua_State* L, int index, const FunctionInfo& function)
    : L_(L), index_(index), function_(function) {
  if (lua_isnoneornil(L, index)) {
    index_ = 0;
    return;
  }
  if (!lua_istable(L, index))
    raise(L, function.name + " takes a table of named fields, got " + describe(L, index) + "; write " +
                 function.usage);
  const std::vector<std::string> known = namesOf(function.fields);
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) {
    if (lua_type(L, -2) != LUA_TSTRING)
      raise(L, function.name + ": every field needs a name; write " + function.usage);
    const std::string name = lua_tostring(L, -2);
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = suggestion(name, known);
    raise(L, function.name + ": unknown field '" + name + "'" +
                 (near.empty() ? "; it takes " + listed(known) : near));
  }
}

std::string FieldReader::what(const char* field) const { return function_.name + ": '" + field + "'"; }

int FieldReader::push(const char* field) const {
  if (!index_) return 0;
  luaL_checkstack(L_, 4, nullptr);
  if (lua_getfield(L_, index_, field) == LUA_TNIL) return lua_pop(L_, 1), 0;
  return lua_gettop(L_);
}

bool FieldReader::has(const char* field) const {
  const int at = push(field);
  if (at) lua_pop(L_, 1);
  return at;
}

void FieldReader::checkRule(const char* field, const Expr& e, Rule rule) const {
  if (rule == Rule::Any || dependsOnSpace(e)) return;
  const double v = uniformValue(e);
  const char* wanted = rule == Rule::Positive && !(v > 0.0)       ? "positive"
                       : rule == Rule::NotNegative && !(v >= 0.0) ? "0 or more"
                       : rule == Rule::NotZero && v == 0.0        ? "other than 0"
                                                                  : nullptr;
  if (!wanted) return;
  lua_pushnumber(L_, v);
  raise(L_, what(field) + " must be " + wanted + ", got " + lua_tostring(L_, -1));
}

Expr FieldReader::number(const char* field, const Expr& fallback, Rule rule) const {
  const int at = push(field);
  if (!at) return fallback;
  const Expr e = readNumber(L_, at, what(field), Depends::OnParameters);
  checkRule(field, e, rule);
  lua_pop(L_, 1);
  return e;
}

double FieldReader::plain(const char* field, double fallback, Rule rule) const {
  const int at = push(field);
  if (!at) return fallback;
  const double v = readPlainNumber(L_, at, what(field));
  checkRule(field, v, rule);
  lua_pop(L_, 1);
  return v;
}

int FieldReader::integer(const char* field, int fallback, int least) const {
  const int at = push(field);
  if (!at) return fallback;
  const int v = readInteger(L_, at, what(field));
  if (v < least)
    raise(L_, what(field) + " must be " + std::to_string(least) + " or more, got " + std::to_string(v));
  lua_pop(L_, 1);
  return v;
}

bool FieldReader::flag(const char* field, bool fallback) const {
  const int at = push(field);
  if (!at) return fallback;
  const bool v = readFlag(L_, at, what(field));
  lua_pop(L_, 1);
  return v;
}

std::string FieldReader::text(const char* field, const std::string& fallback) const {
  const int at = push(field);
  if (!at) return fallback;
  std::string v = readText(L_, at, what(field));
  lua_pop(L_, 1);
  return v;
}

int FieldReader::choice(const char* field, const std::vector<std::string>& choices, int fallback) const {
  const int at = push(field);
  if (!at) return fallback;
  const int v = readChoice(L_, at, what(field), choices);
  lua_pop(L_, 1);
  return v;
}

Vec3E FieldReader::vector(const char* field, const Vec3E& fallback) const {
  const int at = push(field);
  if (!at) return fallback;
  Vec3E v = readVector(L_, at, what(field), 3, Depends::OnParameters);
  lua_pop(L_, 1);
  return v;
}

Vec3E FieldReader::color(const char* field, const Vec3E& fallback, Depends depends) const {
  const int at = push(field);
  if (!at) return fallback;
  Vec3E v = readColor(L_, at, what(field), depends);
  lua_pop(L_, 1);
  return v;
}

Expr FieldReader::surfaceNumber(const char* field, const Expr& fallback, Rule rule) const {
  const int at = push(field);
  if (!at) return fallback;
  Expr e = readSurfaceNumber(L_, at, what(field));
  checkRule(field, e, rule);
  lua_pop(L_, 1);
  return e;
}

std::optional<Box> FieldReader::box(const char* field) const {
  const int at = push(field);
  if (!at) return std::nullopt;
  if (!lua_istable(L_, at) || lua_rawlen(L_, at) != 2)
    raise(L_, what(field) + " must be two corners {{x0, y0, z0}, {x1, y1, z1}}, got " + describe(L_, at));
  lua_rawgeti(L_, at, 1);
  lua_rawgeti(L_, at, 2);
  const Box box = readBox(L_, at + 1, at + 2, what(field));
  lua_pop(L_, 3);
  return box;
}

Box readBox(lua_State* L, int low, int high, const std::string& what) {
  const auto corner = [&](int index) {
    if (!lua_istable(L, index))
      raise(L, what + " must be two corners {x0, y0, z0}, {x1, y1, z1}, got " + describe(L, index));
    const Vec3E v = readVector(L, index, what, 3, Depends::OnParameters);
    if (!v.x.isConstant() || !v.y.isConstant() || !v.z.isConstant())
      raise(L, what + " must be plain numbers, got a formula; value(e) gives its present value");
    return glm::dvec3(v.x.constantValue(), v.y.constantValue(), v.z.constantValue());
  };
  const Box box{corner(low), corner(high)};
  if (!(box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z))
    raise(L, what + ": the first corner must be below the second on every axis");
  return box;
}

}  // namespace sdf
