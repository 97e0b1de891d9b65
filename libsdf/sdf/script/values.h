// Values that scripts and the library hand each other: numbers, formulas, vectors, colours, shapes,
// materials.
//
// `what` names the value in messages: "sphere: 'radius'". Each reader raises a script error that says what
// the value must be and what was given.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "sdf/expr/vec.h"
#include "sdf/shape/shape.h"

struct lua_State;

namespace sdf {

/// Ends the script with "file:line: message", the line being where the script called.
[[noreturn]] void raise(lua_State* L, const std::string& message);
/// Line of the innermost script function; 0 outside of any.
int currentLine(lua_State* L);

/// The known word that `word` is probably a slip of; "" when none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& known);
/// "; did you mean 'sphere'?" or "" when none is near.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);
/// All of the string at this place of the stack, zeros too.
std::string textAt(lua_State* L, int index);
/// Text as Lua writes it in quotes: control characters by their codes, "a\\0b"; what is long is cut.
std::string inLuaQuotes(const std::string& text);
/// What stands at this place of the stack, in words: `a string "big"`, "nothing".
std::string describe(lua_State* L, int index);
/// "1, 2 and 3".
std::string listed(const std::vector<std::string>& words);

/// Makes the types known to the state; call once.
void registerTypes(lua_State* L);
/// Keeps scripts from reading and replacing the metatable on the top of the stack.
void hideMetatable(lua_State* L);
/// Pushes the table of methods that shapes have.
void pushShapeMethods(lua_State* L);
/// Makes the function on the top of the stack the type's operator ("__add"), and pops it.
void setShapeOperator(lua_State* L, const char* event);
void setFormulaOperator(lua_State* L, const char* event);

/// A formula, even of a constant: what is made from a formula is one, whatever its parameters' values fold
/// to.
void pushFormula(lua_State* L, const Expr& e);
/// What the running function made of its arguments: a formula if there is one among these or in a table of
/// them, or a function, or if the result depends on the position; else a plain number.
void pushResult(lua_State* L, const Expr& e);
/// The same as {x, y, z}.
void pushResult(lua_State* L, const Vec3E& v);
void pushShape(lua_State* L, Shape shape);
/// The same of a function's only result, or ends the script with the shape's error. Returns 1.
int pushGood(lua_State* L, Shape shape);
void pushMaterial(lua_State* L, MaterialPtr material);

/// A number or a formula?
bool isNumeric(lua_State* L, int index);
bool isFormula(lua_State* L, int index);
const Shape* testShape(lua_State* L, int index);
/// Does the shape stand for a mesh that the scene is made without (ScriptOptions::withoutMissing)? No other
/// failed shape is ever a script's value.
inline bool isMissing(const Shape& shape) { return !shape.ok(); }
const MaterialPtr* testMaterial(lua_State* L, int index);

/// Has the table at `index` a field with a name?
bool hasNamedField(lua_State* L, int index);
/// The number or formula at `index`, which isNumeric.
Expr exprAt(lua_State* L, int index);

/// What a number may depend on.
enum class Depends {
  OnNothing,     ///< a plain number
  OnParameters,  ///< a plain number or a formula of parameters
  OnPosition     ///< also a formula of the position
};

Expr readNumber(lua_State* L, int index, const std::string& what, Depends depends);
double readPlainNumber(lua_State* L, int index, const std::string& what);
int readInteger(lua_State* L, int index, const std::string& what);
bool readFlag(lua_State* L, int index, const std::string& what);
/// A text without control characters, as names of all kinds are.
std::string readText(lua_State* L, int index, const std::string& what);
int readChoice(lua_State* L, int index, const std::string& what, const std::vector<std::string>& choices);
const Shape& readShape(lua_State* L, int index, const std::string& what);
/// Is it a table with a field x, y or z?
bool isNamedVector(lua_State* L, int index);
/// 2 for the form {x, y}, with or without names, else 3.
int vectorSize(lua_State* L, int index);
/// Calls read(place on the stack) for each value of the list at `index`, in order; `wanted` says what list.
void forEachIn(lua_State* L, int index, const std::string& what, const char* wanted,
               const std::function<void(int)>& read);
/// {x, y, z} or {x = x, y = y, z = z}. `size` is 2 or 3; the components beyond it are 0.
Vec3E readVector(lua_State* L, int index, const std::string& what, int size, Depends depends);
/// The same, or one number for all components, as sizes and factors are often written.
Vec3E readSize(lua_State* L, int index, const std::string& what, int size, Depends depends);
/// A vector of plain numbers.
glm::dvec3 readPoint(lua_State* L, int index, const std::string& what, int size);
/// A number (grey), {r, g, b}, "#rgb" or "#rrggbb" in sRGB, or a function of position and normal.
Vec3E readColor(lua_State* L, int index, const std::string& what, Depends depends);
/// A number, a formula, or a function of position and normal.
Expr readSurfaceNumber(lua_State* L, int index, const std::string& what);
/// A formula of the position: a number, a formula or function(x, y, z).
Expr readFormula(lua_State* L, int index, const std::string& what);

/// Runs a library function so that limits hold and a C++ exception becomes a script error.
using LibraryFunction = int (*)(lua_State*);
int callGuarded(lua_State* L, LibraryFunction f);
template <int (*F)(lua_State*)>
int guarded(lua_State* L) {
  return callGuarded(L, F);
}

}  // namespace sdf
