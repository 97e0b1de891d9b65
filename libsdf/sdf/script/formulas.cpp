// Arithmetic and mathematical functions, on numbers and on formulas alike.
#include <array>
#include <cmath>
#include <lua.hpp>

#include "sdf/number/scalar.h"
#include "sdf/script/context.h"
#include "sdf/script/library.h"

namespace sdf {

namespace {

std::string argumentName(lua_State* L, int i) {
  return runningFunction(L).name + ": argument " + std::to_string(i);
}

Expr argument(lua_State* L, int i) {
  if (!isNumeric(L, i)) raise(L, argumentName(L, i) + " must be a number, got " + describe(L, i));
  return exprAt(L, i);
}

bool allPlain(lua_State* L) {
  for (int i = lua_gettop(L); i > 0; --i)
    if (lua_type(L, i) != LUA_TNUMBER) return false;
  return true;
}

template <double (*OnNumbers)(double), Expr (*OnFormulas)(const Expr&)>
int unary(lua_State* L) {
  expectArguments(L, 1, 1);
  if (allPlain(L))
    lua_pushnumber(L, OnNumbers(lua_tonumber(L, 1)));
  else
    pushResult(L, OnFormulas(argument(L, 1)));
  return 1;
}

// Whole results of plain numbers stay whole numbers, fit for counting and for tables.
template <double (*OnNumbers)(double), Expr (*OnFormulas)(const Expr&)>
int rounding(lua_State* L) {
  unary<OnNumbers, OnFormulas>(L);
  lua_Integer whole;
  if (lua_type(L, -1) == LUA_TNUMBER && lua_numbertointeger(lua_tonumber(L, -1), &whole))
    lua_pushinteger(L, whole);
  return 1;
}

template <Expr (*OnFormulas)(const Expr&, const Expr&)>
int binary(lua_State* L) {
  expectArguments(L, 2, 2);
  pushResult(L, OnFormulas(argument(L, 1), argument(L, 2)));
  return 1;
}

int absolute(lua_State* L) {
  if (lua_isinteger(L, 1)) {
    expectArguments(L, 1, 1);
    const lua_Integer v = lua_tointeger(L, 1);
    return lua_pushinteger(L, v < 0 ? 0 - static_cast<lua_Unsigned>(v) : v), 1;
  }
  return unary<abs, abs>(L);
}

// The least or greatest of any count.
template <bool kGreatest>
int extreme(lua_State* L) {
  expectArguments(L, 1, 1 << 20);
  const int count = lua_gettop(L);
  if (allPlain(L)) {
    int best = 1;
    for (int i = 2; i <= count; ++i)
      if (kGreatest ? lua_compare(L, best, i, LUA_OPLT) : lua_compare(L, i, best, LUA_OPLT)) best = i;
    return lua_pushvalue(L, best), 1;
  }
  Expr e = argument(L, 1);
  for (int i = 2; i <= count; ++i) e = kGreatest ? max(e, argument(L, i)) : min(e, argument(L, i));
  return pushResult(L, e), 1;
}

// Small whole exponents become products: exact for negative bases, and faster than pow.
Expr power(const Expr& a, const Expr& b) {
  if (b.isConstant(1.0)) return a;
  if (b.isConstant(2.0)) return square(a);
  if (b.isConstant(3.0)) return a * square(a);
  if (b.isConstant(4.0)) return square(square(a));
  return pow(a, b);
}

Expr floorDivide(const Expr& a, const Expr& b) { return floor(a / b); }

int modulo(lua_State* L) {
  expectArguments(L, 2, 2);
  if (!allPlain(L)) return binary<mod>(L);
  if (lua_isinteger(L, 2) && lua_tointeger(L, 2) == 0) raise(L, "mod: the second argument must not be 0");
  lua_arith(L, LUA_OPMOD);
  return 1;
}

int arcTangent(lua_State* L) {
  expectArguments(L, 1, 2);
  return lua_gettop(L) == 2 ? binary<atan2>(L) : unary<atan, atan>(L);
}

int logarithm(lua_State* L) {
  expectArguments(L, 1, 2);
  Expr e = log(argument(L, 1));
  if (lua_gettop(L) == 2) e = e / log(argument(L, 2));
  return pushResult(L, e), 1;
}

int clampValue(lua_State* L) {
  expectArguments(L, 3, 3);
  return pushResult(L, clamp(argument(L, 1), argument(L, 2), argument(L, 3))), 1;
}

int mixValues(lua_State* L) {
  expectArguments(L, 3, 3);
  const Expr t = argument(L, 3);
  if (isNumeric(L, 1) && isNumeric(L, 2)) return pushResult(L, mix(exprAt(L, 1), exprAt(L, 2), t)), 1;
  const Vec3E a = readColor(L, 1, argumentName(L, 1), Depends::OnPosition);
  const Vec3E b = readColor(L, 2, argumentName(L, 2), Depends::OnPosition);
  return pushResult(L, mix(a, b, t)), 1;
}

int smoothStep(lua_State* L) {
  expectArguments(L, 3, 3);
  const Expr low = argument(L, 1), high = argument(L, 2);
  const Expr t = clamp((argument(L, 3) - low) / (high - low), 0.0, 1.0);
  // t^2 (3 - 2 t), of which intervals see that it rises up to 3/4 and hardly more than it does beyond.
  return pushResult(L, clamp(t * (1.125 - 2.0 * square(t - 0.75)), 0.0, 1.0)), 1;
}

Expr stepAt(const Expr& edge, const Expr& e) { return lessEqual(edge, e); }
double fractionOf(double a) { return a - std::floor(a); }
Expr fraction(const Expr& a) { return a - floor(a); }
double signOf(double a) { return less(0.0, a) - less(a, 0.0); }
Expr sign(const Expr& a) { return less(0.0, a) - less(a, 0.0); }

// A condition that is known leaves nothing but what it chooses.
Expr chosen(const Expr& condition, const Expr& a, const Expr& b) {
  if (!condition.isConstant()) return select(condition, a, b);
  return condition.constantValue() != 0.0 ? a : b;
}

int selectValue(lua_State* L) {
  const int count = lua_gettop(L);
  if (lua_type(L, 1) == LUA_TSTRING && textAt(L, 1) == "#") return lua_pushinteger(L, count - 1), 1;
  if (count != 3)
    raise(L,
          "select takes a condition and two values, select(less(x, 0), a, b); the n-th of ... is ({...})[n]");
  if (lua_isboolean(L, 1)) return lua_pushvalue(L, lua_toboolean(L, 1) ? 2 : 3), 1;
  const Expr condition = argument(L, 1);
  if (!isFormula(L, 1)) return lua_pushvalue(L, condition.constantValue() != 0.0 ? 2 : 3), 1;
  if (isNumeric(L, 2) && isNumeric(L, 3))
    return pushFormula(L, chosen(condition, exprAt(L, 2), exprAt(L, 3))), 1;
  if (testShape(L, 2) || testShape(L, 3))
    raise(L, "select chooses between numbers and colours; to choose between shapes, use morph or plain 'if'");
  const Vec3E a = readColor(L, 2, argumentName(L, 2), Depends::OnPosition);
  const Vec3E b = readColor(L, 3, argumentName(L, 3), Depends::OnPosition);
  return pushResult(L,
                    {chosen(condition, a.x, b.x), chosen(condition, a.y, b.y), chosen(condition, a.z, b.z)}),
         1;
}

// Numbers in a row or one {x, y, z}, gathered from the arguments.
int lengthOf(lua_State* L) {
  if (lua_istable(L, 1)) {
    expectArguments(L, 1, 1);
    const int size = vectorSize(L, 1);
    const Vec3E v = readVector(L, 1, argumentName(L, 1), size, Depends::OnPosition);
    return pushResult(L, size == 2 ? length(v.x, v.y) : length(v)), 1;
  }
  expectArguments(L, 1, 3);
  const Expr a = argument(L, 1);
  if (lua_gettop(L) == 1) return pushResult(L, abs(a)), 1;
  const Expr b = argument(L, 2);
  return pushResult(L, lua_gettop(L) == 2 ? length(a, b) : length(a, b, argument(L, 3))), 1;
}

int dotProduct(lua_State* L) {
  expectArguments(L, 2, 2);
  const int size = vectorSize(L, 1);
  const Vec3E a = readVector(L, 1, argumentName(L, 1), size, Depends::OnPosition);
  const Vec3E b = readVector(L, 2, argumentName(L, 2), size, Depends::OnPosition);
  return pushResult(L, dot(a, b)), 1;
}

int presentValue(lua_State* L) {
  expectArguments(L, 1, 1);
  if (lua_type(L, 1) == LUA_TNUMBER) return lua_pushvalue(L, 1), 1;
  const Expr e = argument(L, 1);
  if (dependsOnSpace(e)) raise(L, "value: the formula depends on the position, so it has no single value");
  noteValuesRead(contextOf(L), e);
  const double v = uniformValue(e);
  lua_Integer whole;
  if (v == std::floor(v) && lua_numbertointeger(v, &whole))
    lua_pushinteger(L, whole);
  else
    lua_pushnumber(L, v);
  return 1;
}

// --- operators ---

Expr operand(lua_State* L, int i, const char* sign) {
  if (!isNumeric(L, i))
    raise(L, std::string("'") + sign + "' needs a number or a formula on both sides, got " + describe(L, i));
  return exprAt(L, i);
}

Expr plus(const Expr& a, const Expr& b) { return a + b; }
Expr minus(const Expr& a, const Expr& b) { return a - b; }
Expr times(const Expr& a, const Expr& b) { return a * b; }
Expr over(const Expr& a, const Expr& b) { return a / b; }

struct FormulaSign {
  const char* event;
  const char* sign;
  Expr (*apply)(const Expr&, const Expr&);
};
constexpr FormulaSign kFormulaSigns[] = {
    {"__add", "+", plus}, {"__sub", "-", minus}, {"__mul", "*", times},        {"__div", "/", over},
    {"__mod", "%", mod},  {"__pow", "^", power}, {"__idiv", "//", floorDivide}};

int arithmetic(lua_State* L) {
  const auto& s = *static_cast<const FormulaSign*>(lua_touserdata(L, lua_upvalueindex(1)));
  pushFormula(L, s.apply(operand(L, 1, s.sign), operand(L, 2, s.sign)));
  return 1;
}

int negate(lua_State* L) { return pushFormula(L, -exprAt(L, 1)), 1; }

int compare(lua_State* L) {
  raise(L,
        "a formula cannot be compared, for its value may change; write value(k) for the present value of a "
        "parameter k, or choose with select(less(a, b), x, y)");
}

int formulaText(lua_State* L) { return lua_pushliteral(L, "formula"), 1; }

}  // namespace

void openFormulaOperators(lua_State* L) {
  for (const FormulaSign& s : kFormulaSigns) {
    lua_pushlightuserdata(L, const_cast<FormulaSign*>(&s));
    lua_pushcclosure(L, guarded<arithmetic>, 1);
    setFormulaOperator(L, s.event);
  }
  lua_pushcfunction(L, guarded<negate>);
  setFormulaOperator(L, "__unm");
  for (const char* event : {"__lt", "__le", "__eq"}) {
    lua_pushcfunction(L, guarded<compare>);
    setFormulaOperator(L, event);
  }
  lua_pushcfunction(L, formulaText);
  setFormulaOperator(L, "__tostring");
}

// clang-format off
const std::vector<FunctionInfo>& formulaLibrary() {
  static const std::vector<FunctionInfo> library{
      {"sin", "sin(a)", "sine; radians", {}, unary<sin, sin>},
      {"cos", "cos(a)", "cosine; radians", {}, unary<cos, cos>},
      {"tan", "tan(a)", "tangent; radians", {}, unary<tan, tan>},
      {"asin", "asin(a)", "inverse sine; radians", {}, unary<asin, asin>},
      {"acos", "acos(a)", "inverse cosine; radians", {}, unary<acos, acos>},
      {"atan", "atan(y, x)", "angle of (x, y), or inverse tangent of y alone; radians", {}, arcTangent},
      {"exp", "exp(a)", "e to the power a", {}, unary<exp, exp>},
      {"log", "log(a, base)", "logarithm; natural without a base", {}, logarithm},
      {"sqrt", "sqrt(a)", "square root", {}, unary<sqrt, sqrt>},
      {"square", "square(a)", "a * a", {}, unary<square, square>},
      {"pow", "pow(a, b)", "a to the power b, as a ^ b", {}, binary<power>},
      {"abs", "abs(a)", "a without its sign", {}, absolute},
      {"sign", "sign(a)", "-1, 0 or 1", {}, unary<signOf, sign>},
      {"floor", "floor(a)", "next whole number below", {}, rounding<floor, floor>},
      {"ceil", "ceil(a)", "next whole number above", {}, rounding<ceil, ceil>},
      {"round", "round(a)", "nearest whole number, halves to the even one", {}, rounding<round, round>},
      {"fract", "fract(a)", "a - floor(a)", {}, unary<fractionOf, fraction>},
      {"mod", "mod(a, b)", "a - b * floor(a / b), as a % b", {}, modulo},
      {"min", "min(a, b, …)", "least", {}, extreme<false>},
      {"max", "max(a, b, …)", "greatest", {}, extreme<true>},
      {"clamp", "clamp(a, low, high)", "a kept within low … high", {}, clampValue},
      {"mix", "mix(a, b, t)", "a + (b - a) t, for numbers and for colours", {}, mixValues},
      {"step", "step(edge, a)", "1 where a >= edge, 0 elsewhere", {}, binary<stepAt>},
      {"smoothstep", "smoothstep(low, high, a)", "from 0 at low to 1 at high without corners", {}, smoothStep},
      {"less", "less(a, b)", "1 where a < b, 0 elsewhere", {}, binary<less>},
      {"less_equal", "less_equal(a, b)", "1 where a <= b, 0 elsewhere", {}, binary<lessEqual>},
      {"equal", "equal(a, b)", "1 where a == b, 0 elsewhere", {}, binary<equal>},
      {"select", "select(condition, a, b)", "a where the condition is not 0 (or is true), b elsewhere; numbers or colours",
       {}, selectValue},
      {"length", "length(a, b, c)", "Euclidean length of one to three numbers, or of a {x, y, z}", {}, lengthOf},
      {"dot", "dot(a, b)", "scalar product of two {x, y, z} or two {x, y}", {}, dotProduct},
      {"value", "value(e)",
       "the present value of a formula of parameters, as a plain number; for another value the script runs again",
       {}, presentValue},
  };
  return library;
}
// clang-format on

}  // namespace sdf
