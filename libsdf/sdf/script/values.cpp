#include "sdf/script/values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <lua.hpp>
#include <new>
#include <utility>

#include "sdf/base/srgb.h"
#include "sdf/expr/depth.h"
#include "sdf/expr/origin.h"
#include "sdf/script/context.h"
#include "sdf/script/library.h"
#include "sdf/shape/catalog.h"

namespace sdf {

namespace {

constexpr const char* kFormula = "formula";
constexpr const char* kShape = "shape";
constexpr const char* kMaterial = "material";
constexpr const char* kShapeMethods = "shape methods";

template <class T>
int destroy(lua_State* L) {
  static_cast<T*>(lua_touserdata(L, 1))->~T();
  return 0;
}

template <class T>
void pushValue(lua_State* L, const char* type, T value) {
  new (lua_newuserdatauv(L, sizeof(T), 0)) T(std::move(value));
  luaL_setmetatable(L, type);
}

void makeType(lua_State* L, const char* type, lua_CFunction finish, lua_CFunction field) {
  luaL_newmetatable(L, type);
  lua_pushcfunction(L, finish);
  lua_setfield(L, -2, "__gc");
  lua_pushcfunction(L, field);
  lua_setfield(L, -2, "__index");
  hideMetatable(L);
  lua_pop(L, 1);
}

// Fields of values that have none.
int noField(lua_State* L) {
  const std::string key = lua_type(L, 2) == LUA_TSTRING ? textAt(L, 2) : "?";
  const std::string what = isFormula(L, 1) ? "formula" : "material";
  raise(L, "a " + what + " has no field '" + key + "'; it is one value");
}

int shapeField(lua_State* L) {
  luaL_getmetatable(L, kShapeMethods);
  lua_pushvalue(L, 2);
  if (lua_rawget(L, -2) != LUA_TNIL) return 1;
  std::vector<std::string> known;
  for (lua_pushnil(L); lua_next(L, -3); lua_pop(L, 1)) known.push_back(textAt(L, -2));
  const std::string word = lua_type(L, 2) == LUA_TSTRING ? textAt(L, 2) : "?";
  raise(L, "a shape has no '" + word + "'" + suggestion(word, known));
}

}  // namespace

int currentLine(lua_State* L) {
  lua_Debug frame;
  for (int level = 0; lua_getstack(L, level, &frame); ++level)
    if (lua_getinfo(L, "l", &frame) && frame.currentline > 0) return frame.currentline;
  return 0;
}

void raise(lua_State* L, const std::string& message) {
  const int line = currentLine(L);
  const std::string where = contextOf(L).shortName + (line ? ":" + std::to_string(line) : std::string());
  lua_pushlstring(L, (where + ": " + message).c_str(), where.size() + 2 + message.size());
  lua_error(L);
  std::terminate();  // lua_error does not return
}

int callGuarded(lua_State* L, LibraryFunction f) {
  try {
    checkLimits(L);
    const Origin origin("formula", contextOf(L).file, currentLine(L));
    return f(L);
  } catch (const NodeLimitReached&) {
    lua_gc(L, LUA_GCCOLLECT);
    const std::size_t mebibytes = contextOf(L).options.memoryLimit >> 20;
    raise(L, "the formulas need more than " + std::to_string(mebibytes) +
                 " MiB of memory; look for a shape that doubles in a loop");
  } catch (const std::exception& e) {
    raise(L, e.what());
  }
}

namespace {

// Edit distance with neighbours swapped counting once (Damerau 1964, Levenshtein 1966).
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

// Its words, which underscores part, by the alphabet.
std::string sortedWords(const std::string& name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if (c == '_')
      words.emplace_back();
    else
      words.back() += c;
  }
  std::ranges::sort(words);
  std::string sorted;
  for (const std::string& w : words) sorted += w + '_';
  return sorted;
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongestName = 40;
  std::string best;
  if (word.size() > kLongestName) return best;
  std::size_t allowed =
      std::max<std::size_t>(1, word.size() / 3);  // a third of the letters may be wrong, not all
  allowed = std::min(allowed + 1, word.size());
  for (const std::string& candidate : known) {
    if (candidate.size() > kLongestName) continue;
    // Words in another order are one mistake.
    const std::size_t d =
        std::min(editDistance(word, candidate), 1 + editDistance(sortedWords(word), sortedWords(candidate)));
    if (d >= allowed) continue;
    best = candidate;
    allowed = d;
  }
  return best;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest(word, known);
  return near.empty() ? near : "; did you mean '" + near + "'?";
}

std::string textAt(lua_State* L, int index) {
  std::size_t size = 0;
  const char* text = lua_tolstring(L, index, &size);
  return {text, size};
}

namespace {

bool isControl(char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }

}  // namespace

std::string inLuaQuotes(const std::string& text) {
  constexpr std::size_t kShown = 40;
  std::string shown;
  for (const char c : text.substr(0, kShown))
    shown += isControl(c) ? "\\" + std::to_string(static_cast<int>(c)) : std::string(1, c);
  return "\"" + shown + (text.size() > kShown ? "…\"" : "\"");
}

std::string describe(lua_State* L, int index) {
  switch (lua_type(L, index)) {
    case LUA_TNONE:
    case LUA_TNIL:
      return "nothing";
    case LUA_TBOOLEAN:
      return lua_toboolean(L, index) ? "true" : "false";
    case LUA_TNUMBER: {
      lua_pushvalue(L, index);  // lua_tostring would change the value in place
      const std::string text = textAt(L, -1);
      lua_pop(L, 1);
      return "the number " + text;
    }
    case LUA_TSTRING:
      return "a string " + inLuaQuotes(textAt(L, index));
    case LUA_TUSERDATA:
      return isFormula(L, index) ? "a formula" : testShape(L, index) ? "a shape" : "a material";
    default:
      return std::string("a ") + luaL_typename(L, index);
  }
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

void registerTypes(lua_State* L) {
  makeType(L, kFormula, destroy<Expr>, guarded<noField>);
  makeType(L, kMaterial, destroy<MaterialPtr>, guarded<noField>);
  makeType(L, kShape, destroy<Shape>, guarded<shapeField>);
  luaL_newmetatable(L, kShapeMethods);
  lua_pop(L, 1);
}

void hideMetatable(lua_State* L) {
  lua_pushboolean(L, false);
  lua_setfield(L, -2, "__metatable");
}

void pushShapeMethods(lua_State* L) { luaL_getmetatable(L, kShapeMethods); }

void setOperator(lua_State* L, const char* type, const char* event) {
  luaL_getmetatable(L, type);
  lua_insert(L, -2);
  lua_setfield(L, -2, event);
  lua_pop(L, 1);
}
void setShapeOperator(lua_State* L, const char* event) { setOperator(L, kShape, event); }
void setFormulaOperator(lua_State* L, const char* event) { setOperator(L, kFormula, event); }

namespace {

// Graphics drivers compile expressions by recursion: 20,000 operations upon one another end Mesa's, 8,000 do
// not, and gradients stand some times as deep. And each operator goes through all that a shape is made of, so
// that n of them take n^2: some seconds for as many as these.
constexpr std::uint32_t kDeepestFormula = 4096;

void checkDepth(lua_State* L, const Expr& e, const std::string& what, const std::string& advice) {
  if (depthOf(e) <= kDeepestFormula) return;
  raise(L, what + " has " + std::to_string(depthOf(e)) + " operations upon one another, and up to " +
               std::to_string(kDeepestFormula) + " can be drawn and meshed; " + advice);
}

}  // namespace

void pushFormula(lua_State* L, const Expr& e) {
  checkDepth(L, e, "the formula", "look for a loop that can be shorter");
  pushValue(L, kFormula, e);
}

namespace {

bool isPlain(lua_State* L, int index) {
  if (lua_isfunction(L, index) || isFormula(L, index)) return false;
  if (!lua_istable(L, index)) return true;
  bool plain = true;
  for (lua_pushnil(L); plain && lua_next(L, index); lua_pop(L, 1)) plain = !isFormula(L, -1);
  if (!plain) lua_pop(L, 1);
  return plain;
}

bool plainArguments(lua_State* L) {
  for (int i = lua_gettop(L); i > 0; --i)
    if (!isPlain(L, i)) return false;
  return true;
}

void pushNumeric(lua_State* L, const Expr& e, bool plain) {
  if (plain && e.isConstant())
    lua_pushnumber(L, e.constantValue());
  else
    pushFormula(L, e);
}

}  // namespace

void pushResult(lua_State* L, const Expr& e) { pushNumeric(L, e, plainArguments(L)); }
void pushResult(lua_State* L, const Vec3E& v) {
  const bool plain = plainArguments(L);
  lua_createtable(L, 3, 0);
  int i = 0;
  for (const Expr* e : {&v.x, &v.y, &v.z}) {
    pushNumeric(L, *e, plain);
    lua_rawseti(L, -2, ++i);
  }
}
// A hard union is read by its operands, however many there are.
void pushShape(lua_State* L, Shape shape) {
  if (!shape.outer || shape.outer->blend.kind != Blend::Kind::Hard)
    checkDepth(L, shape.distance, "the shape",
               "give all shapes to one union(list), intersection or difference, and each operator once");
  pushValue(L, kShape, std::move(shape));
}

int pushGood(lua_State* L, Shape shape) {
  if (!shape.ok()) raise(L, *shape.error);
  return pushShape(L, std::move(shape)), 1;
}
void pushMaterial(lua_State* L, MaterialPtr material) { pushValue(L, kMaterial, std::move(material)); }

bool isFormula(lua_State* L, int index) { return luaL_testudata(L, index, kFormula); }
bool isNumeric(lua_State* L, int index) { return lua_type(L, index) == LUA_TNUMBER || isFormula(L, index); }
const Shape* testShape(lua_State* L, int index) {
  return static_cast<const Shape*>(luaL_testudata(L, index, kShape));
}
const MaterialPtr* testMaterial(lua_State* L, int index) {
  return static_cast<const MaterialPtr*>(luaL_testudata(L, index, kMaterial));
}

Expr exprAt(lua_State* L, int index) {
  if (const void* e = luaL_testudata(L, index, kFormula)) return *static_cast<const Expr*>(e);
  return Expr(lua_tonumber(L, index));
}

namespace {

[[noreturn]] void wrongType(lua_State* L, int index, const std::string& what, const std::string& wanted) {
  raise(L, what + " must be " + wanted + ", got " + describe(L, index));
}

}  // namespace

Expr readNumber(lua_State* L, int index, const std::string& what, Depends depends) {
  if (!isNumeric(L, index)) wrongType(L, index, what, "a number");
  if (depends == Depends::OnNothing && isFormula(L, index))
    raise(L, what + " must be a plain number, got a formula; value(e) gives its present value");
  const Expr e = exprAt(L, index);
  if (!e.isConstant() && dependsOnSpace(e)) {
    if (depends == Depends::OnPosition) return e;
    raise(L, what + " must not depend on the position; it is one number for the whole scene");
  }
  if (const double v = uniformValue(e); !std::isfinite(v))
    raise(L, what + " must be a finite number, got " +
                 (std::isnan(v) ? "NaN, which is not a number" : "infinity"));
  return e;
}

double readPlainNumber(lua_State* L, int index, const std::string& what) {
  return readNumber(L, index, what, Depends::OnNothing).constantValue();
}

int readInteger(lua_State* L, int index, const std::string& what) {
  const double v = readPlainNumber(L, index, what);
  constexpr double kLargest = 1e9;
  if (v != std::floor(v)) wrongType(L, index, what, "a whole number");
  if (std::abs(v) > kLargest) wrongType(L, index, what, "a whole number from -1e9 to 1e9");
  return static_cast<int>(v);
}

void forEachIn(lua_State* L, int index, const std::string& what, const char* wanted,
               const std::function<void(int)>& read) {
  if (!lua_istable(L, index)) wrongType(L, index, what, wanted);
  luaL_checkstack(L, 8, nullptr);
  const auto count = static_cast<lua_Integer>(lua_rawlen(L, index));
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(L, index, i);
    read(lua_gettop(L));
    lua_pop(L, 1);
  }
}

bool hasNamedField(lua_State* L, int index) {
  bool named = false;
  for (lua_pushnil(L); !named && lua_next(L, index); lua_pop(L, 1)) named = lua_type(L, -2) == LUA_TSTRING;
  if (named) lua_pop(L, 1);
  return named;
}

bool readFlag(lua_State* L, int index, const std::string& what) {
  if (!lua_isboolean(L, index)) wrongType(L, index, what, "true or false");
  return lua_toboolean(L, index);
}

std::string readText(lua_State* L, int index, const std::string& what) {
  if (lua_type(L, index) != LUA_TSTRING) wrongType(L, index, what, "a text");
  const std::string text = textAt(L, index);
  if (std::ranges::any_of(text, isControl))
    raise(L, what + " must be without control characters, got " + inLuaQuotes(text));
  return text;
}

int readChoice(lua_State* L, int index, const std::string& what, const std::vector<std::string>& choices) {
  if (lua_type(L, index) == LUA_TSTRING) {
    const auto it = std::ranges::find(choices, textAt(L, index));
    if (it != choices.end()) return static_cast<int>(it - choices.begin());
  }
  wrongType(L, index, what, "one of " + shown(choices));
}

const Shape& readShape(lua_State* L, int index, const std::string& what) {
  const Shape* shape = testShape(L, index);
  if (!shape) wrongType(L, index, what, "a shape");
  return *shape;
}

namespace {

bool isList(lua_State* L, int index, int size) {
  return lua_istable(L, index) && static_cast<int>(lua_rawlen(L, index)) == size;
}

constexpr const char* kAxes[] = {"x", "y", "z"};

bool hasField(lua_State* L, int index, const char* name) {
  lua_pushstring(L, name);
  const bool has = lua_rawget(L, index) != LUA_TNIL;
  lua_pop(L, 1);
  return has;
}

// Component i (from 1) of the table at `index`.
Expr component(lua_State* L, int index, int i, bool named, const std::string& what, Depends depends) {
  if (named) {
    lua_pushstring(L, kAxes[i - 1]);
    lua_rawget(L, index);
  } else {
    lua_rawgeti(L, index, i);
  }
  const std::string which = named ? kAxes[i - 1] : "number " + std::to_string(i);
  Expr e = readNumber(L, lua_gettop(L), which + " of " + what, depends);
  lua_pop(L, 1);
  return e;
}

// Says what to write where one number stands in place of a vector: "{2, 0} or {0, 2}".
std::string alongEachAxis(lua_State* L, int index, int size) {
  const std::string number = isFormula(L, index) ? "k" : shown(lua_tonumber(L, index));
  std::string text;
  for (int axis = 0; axis < size; ++axis) {
    text += axis == 0 ? "{" : axis + 1 < size ? ", {" : " or {";
    for (int i = 0; i < size; ++i) text += (i == 0 ? "" : ", ") + (i == axis ? number : "0");
    text += "}";
  }
  return text;
}

[[noreturn]] void noVector(lua_State* L, int index, const std::string& what, const std::string& wanted,
                           int size) {
  const std::string got = lua_istable(L, index)
                              ? "a table of " + std::to_string(lua_rawlen(L, index)) + " values"
                              : describe(L, index);
  raise(L, what + " must be " + wanted + ", got " + got +
               (isNumeric(L, index) ? "; write " + alongEachAxis(L, index, size) : ""));
}

Vec3E colorFromText(lua_State* L, const std::string& text, const std::string& what) {
  const bool valid = (text.size() == 4 || text.size() == 7) && text[0] == '#' &&
                     text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (!valid) raise(L, what + " must be a colour like \"#ff8800\", got " + inLuaQuotes(text));
  const std::size_t digits = text.size() / 3;
  std::array<Expr, 3> c;
  for (std::size_t i = 0; i < 3; ++i) {
    const int v = std::stoi(text.substr(1 + i * digits, digits), nullptr, 16);
    c[i] = linearOf((digits == 1 ? v * 17 : v) / 255.0);
  }
  return {c[0], c[1], c[2]};
}

// Calls the function with the position, or with all variables, the normal too; its results are left on the
// stack.
int callInSpace(lua_State* L, int index, int variables, int results) {
  const int before = lua_gettop(L);
  luaL_checkstack(L, 8, nullptr);
  lua_pushvalue(L, index);
  for (int v = 0; v < variables; ++v) pushFormula(L, Expr::variable(static_cast<Variable>(v)));
  lua_call(L, variables, results);
  return lua_gettop(L) - before;
}

// A number, a formula, or the one number that a function returns.
Expr readInSpace(lua_State* L, int index, const std::string& what, const char* wanted, int variables,
                 int results) {
  if (!lua_isfunction(L, index)) {
    if (!isNumeric(L, index)) wrongType(L, index, what, wanted);
    return readNumber(L, index, what, Depends::OnPosition);
  }
  const int count = callInSpace(L, index, variables, results);
  if (count != 1) raise(L, what + " must return one number, returned " + std::to_string(count) + " values");
  Expr e = readNumber(L, lua_gettop(L), "the result of " + what, Depends::OnPosition);
  lua_pop(L, 1);
  return e;
}

constexpr const char* kColorForms = "a colour (a number, {r, g, b}, \"#rrggbb\" or a function of x, y, z)";

}  // namespace

bool isNamedVector(lua_State* L, int index) {
  return lua_istable(L, index) &&
         std::ranges::any_of(kAxes, [&](const char* axis) { return hasField(L, index, axis); });
}

int vectorSize(lua_State* L, int index) {
  return isNamedVector(L, index) ? (hasField(L, index, "z") ? 3 : 2) : isList(L, index, 2) ? 2 : 3;
}

Vec3E readVector(lua_State* L, int index, const std::string& what, int size, Depends depends) {
  const bool named = isNamedVector(L, index);
  if (named)
    checkNames(L, index, what, {kAxes, kAxes + size}, size == 3 ? "{x = 1, y = 2, z = 3}" : "{x = 1, y = 2}");
  else if (!isList(L, index, size))
    noVector(L, index, what, size == 3 ? "{x, y, z}" : "{x, y}", size);
  const auto number = [&](int i) { return component(L, index, i, named, what, depends); };
  return {number(1), number(2), size == 3 ? number(3) : Expr(0.0)};
}

Vec3E readSize(lua_State* L, int index, const std::string& what, int size, Depends depends) {
  if (isNumeric(L, index)) {
    const Expr e = readNumber(L, index, what, depends);
    return {e, e, size == 3 ? e : Expr(0.0)};
  }
  if (!isNamedVector(L, index) && !isList(L, index, size))
    noVector(L, index, what, size == 3 ? "{x, y, z} or a number" : "{x, y} or a number", size);
  return readVector(L, index, what, size, depends);
}

glm::dvec3 readPoint(lua_State* L, int index, const std::string& what, int size) {
  const Vec3E v = readVector(L, index, what, size, Depends::OnNothing);
  return {v.x.constantValue(), v.y.constantValue(), v.z.constantValue()};
}

Vec3E readColor(lua_State* L, int index, const std::string& what, Depends depends) {
  if (isNumeric(L, index)) return readNumber(L, index, what, depends);
  if (lua_type(L, index) == LUA_TSTRING) return colorFromText(L, textAt(L, index), what);
  if (isList(L, index, 3)) return readVector(L, index, what, 3, depends);
  if (!lua_isfunction(L, index)) wrongType(L, index, what, kColorForms);
  if (depends == Depends::OnParameters)
    raise(L, what + " must not depend on the position; give a plain colour");
  const int count = callInSpace(L, index, kVariableCount, LUA_MULTRET);
  const int first = lua_gettop(L) - count + 1;
  Vec3E color;
  if (count == 3)
    color = {readNumber(L, first, "red of " + what, depends),
             readNumber(L, first + 1, "green of " + what, depends),
             readNumber(L, first + 2, "blue of " + what, depends)};
  else if (count == 1 && !lua_isfunction(L, first))
    color = readColor(L, first, "the result of " + what, depends);
  else
    raise(L, what + " must return r, g, b or one colour, returned " +
                 (count == 1 ? describe(L, first) : std::to_string(count) + " values"));
  lua_pop(L, count);
  return color;
}

Expr readSurfaceNumber(lua_State* L, int index, const std::string& what) {
  return readInSpace(L, index, what, "a number or a function of x, y, z", kVariableCount, LUA_MULTRET);
}

Expr readFormula(lua_State* L, int index, const std::string& what) {
  return readInSpace(L, index, what, "a formula or a function of x, y, z", 3, 1);
}

}  // namespace sdf
