// Shapes in the scene language: one function for each entry of the catalog, and the ways in which its
// arguments can be written; and shapes that are written as formulas of the position.
#include <algorithm>
#include <chrono>
#include <lua.hpp>

#include "sdf/expr/origin.h"
#include "sdf/script/context.h"
#include "sdf/script/library.h"
#include "sdf/script/meshes.h"
#include "sdf/script/outlines.h"
#include "sdf/script/tubes.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"
#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"
#include "sdf/shape/solids/triangle_solid.h"

namespace sdf {

namespace {

// Remembers a call whose result depends on how far away its shapes are, where their distances may not tell.
void noteOffsets(lua_State* L, const CatalogEntry& entry, const std::vector<Argument>& given,
                 const Shape& result) {
  constexpr std::size_t kMostNotes = 16;  // of some ten milliseconds each
  ScriptContext& c = contextOf(L);
  const auto note = [&](const std::string& reader, const std::string& since, const OffsetToCheck& offset) {
    const std::string place = c.file + ":" + std::to_string(currentLine(L)) + ": " + entry.name;
    const bool known = std::ranges::find(c.offsets, place, &OffsetNote::place) != c.offsets.end();
    if (!known && c.offsets.size() < kMostNotes) c.offsets.push_back({place, reader, since, offset});
  };
  if (entry.name == "round" || entry.name == "shell") {
    const Shape& s = std::get<Shape>(given[0]);
    const bool isShell = entry.name == "shell";
    if (s.claim.kind <= (isShell ? ClaimKind::Exact : ClaimKind::ExactOutside)) return;
    const Expr amount = std::get<Expr>(given[1]) * (isShell ? 0.5 : 1.0);
    note("the surface is", s.inexactSince, {s.distance, result.distance, amount, s.bounds, true, isShell});
  }
  if (entry.group != Group::Boolean || given[1].index() == 0) return;
  const Expr k = std::get<Expr>(given[1]);
  const auto& shapes = std::get<std::vector<Shape>>(given[0]);
  for (const Shape& s : shapes) {
    if (s.claim.kind != ClaimKind::Field) continue;
    const Expr read = readyToBlend(s, Blend::quadratic(k)).distance, half = k * 0.5;
    const bool isCutter = entry.name == "difference" && &s != shapes.data();
    const bool out = entry.name == "union" || isCutter;
    note("what it blends is", s.inexactSince,
         {s.distance, out ? read - half : -read - half, half, s.bounds, out, !out, false});
  }
}

// One call of a catalog entry: gives each parameter the arguments that were written for it.
//
// Arguments come in the order of the parameters, or by name in a table that stands last. A table that stands
// alone (or alone after the shape of a method) may hold both. A vector is a table, as many numbers in a row
// as it has components, or where it is a size one number; a list of shapes or points is a table or the
// arguments in a row.
class Call {
 public:
  Call(lua_State* L, const CatalogEntry& entry) : L_(L), entry_(entry) {}

  /// Returns a failed shape where one among the arguments is missing that it cannot do without.
  Shape run() {
    gather();
    std::vector<Argument> values;
    for (const Parameter& p : entry_.parameters) values.push_back(valueOf(p));
    if (next_ <= last_)
      raise(L_, entry_.name + ": too many arguments, the first one too many is " + describe(L_, next_) +
                    "; write " + usageOf(entry_));
    for (Argument& value : values)
      if (const auto missing = leaveOut(value)) return *missing;
    const Origin origin(entry_.name.c_str(), contextOf(L_).file, currentLine(L_));
    const std::vector<Argument> given = entry_.group == Group::Solid ? std::vector<Argument>() : values;
    Shape result = build(entry_, std::move(values));
    if (!result.ok()) raise(L_, *result.error);
    if (result.formulaAt.empty()) result.formulaAt = formulaAt_, result.takesLipschitz = takesLipschitz_;
    const bool isWeaker = result.claim.kind > weakest_;
    result.inexactSince =
        isWeaker ? entry_.name + " in line " + std::to_string(currentLine(L_)) : inexactSince_;
    noteOffsets(L_, entry_, given, result);
    return result;
  }

 private:
  // What is missing (isMissing) adds nothing to unions, and takes nothing away. A shape that is made of it
  // alone is missing, too.
  std::optional<Shape> leaveOut(Argument& value) const {
    if (const auto* shape = std::get_if<Shape>(&value))
      return isMissing(*shape) ? std::optional(*shape) : std::nullopt;
    auto* shapes = std::get_if<std::vector<Shape>>(&value);
    if (!shapes || std::ranges::none_of(*shapes, isMissing)) return {};
    const Shape first = *std::ranges::find_if(*shapes, isMissing);
    const bool needsAll = entry_.name == "intersection", needsFirst = entry_.name == "difference";
    if (needsAll || (needsFirst && isMissing(shapes->front()))) return first;
    std::erase_if(*shapes, isMissing);
    return shapes->empty() ? std::optional(first) : std::nullopt;
  }

  // Finds the table of named fields, and spreads a table that stands for the argument list.
  void gather() {
    last_ = lua_gettop(L_);
    const bool table = last_ > 0 && lua_istable(L_, last_) && !isNamedVector(L_, last_);
    const bool alone = last_ == 1 || (last_ == 2 && testShape(L_, 1));
    if (table && hasNamedField(L_, last_)) {
      options_ = last_--;
      std::vector<std::string> known;
      for (const Parameter& p : entry_.parameters) known.push_back(p.name);
      checkNames(L_, options_, entry_.name, known);
    }
    if (!table || !alone) return;
    const int list = options_ ? options_ : last_--;
    const int count = static_cast<int>(std::min<lua_Unsigned>(lua_rawlen(L_, list), kMostArguments + 1));
    if (count > kMostArguments)
      raise(L_, entry_.name + ": more than " + std::to_string(kMostArguments) + " arguments");
    luaL_checkstack(L_, count + 8, nullptr);
    for (int i = 1; i <= count; ++i) lua_rawgeti(L_, list, i);
    // The list's own place is below the values: move them down over it where it is not needed any more.
    if (options_) {
      lua_pushvalue(L_, options_);
      lua_remove(L_, list);
      options_ = lua_gettop(L_);
    } else {
      lua_remove(L_, list);
    }
    last_ += count;
  }

  static Depends dependsOf(const Parameter& p) {
    return p.rule == Rule::Count ? Depends::OnNothing : Depends::OnParameters;
  }
  // One number may stand for all components of a size, a factor or a count: of vectors with a rule. Places
  // and directions have none.
  static bool isSize(const Parameter& p) { return p.rule != Rule::Any; }
  static int sizeOf(const Parameter& p) { return p.kind == ArgumentKind::Vector2 ? 2 : 3; }
  std::string what(const Parameter& p) const { return entry_.name + ": '" + p.name + "'"; }

  Argument valueOf(const Parameter& p) {
    if (options_ && lua_getfield(L_, options_, p.name.c_str()) != LUA_TNIL) {
      // Unless p is the last, an argument in place may belong to a later parameter.
      if (next_ <= last_ && &p == &entry_.parameters.back())
        raise(L_, what(p) + " is given twice, by place and by name");
      const int at = lua_gettop(L_);
      Argument value = readOne(p, at);
      lua_settop(L_, options_);
      return value;
    }
    if (options_) lua_settop(L_, options_);
    if (next_ > last_ || lua_isnil(L_, next_)) {
      if (next_ <= last_) ++next_;
      if (!p.required) return std::monostate{};
      raise(L_, what(p) + " is missing; write " + usageOf(entry_));
    }
    return readRow(p);
  }

  Argument readOne(const Parameter& p, int at) {
    switch (p.kind) {
      case ArgumentKind::Number:
        return readNumber(L_, at, what(p), Depends::OnParameters);
      case ArgumentKind::Integer:
        return readInteger(L_, at, what(p));
      case ArgumentKind::Choice:
        return readChoice(L_, at, what(p), p.choices);
      case ArgumentKind::Vector2:
      case ArgumentKind::Vector3:
        if (flat_ && sizeOf(p) == 3) return readInPlane(p, at);
        return (isSize(p) ? readSize : readVector)(L_, at, what(p), sizeOf(p), dependsOf(p));
      case ArgumentKind::Shape:
        return shapeAt(p, at);
      case ArgumentKind::Shapes:
        return readList<Shape>(p, at, "a list of shapes", [&](int i) { return shapeAt(p, i); });
      case ArgumentKind::Points:
        return readList<glm::dvec2>(p, at, "a list of points {{x, y}, …}",
                                    [&](int i) { return readPoint(L_, i, what(p), 2); });
    }
    return std::monostate{};
  }

  // Reads p from the arguments in a row, from next_ on.
  Argument readRow(const Parameter& p) {
    switch (p.kind) {
      case ArgumentKind::Vector2:
      case ArgumentKind::Vector3:
        return readSpreadVector(p, sizeOf(p));
      case ArgumentKind::Shapes:
        if (!testShape(L_, next_)) break;
        return takeWhile<Shape>([&] { return testShape(L_, next_) != nullptr; },
                                [&](int i) { return shapeAt(p, i); });
      case ArgumentKind::Points:
        if (!isPoint(next_)) break;
        return takeWhile<glm::dvec2>([&] { return isPoint(next_); },
                                     [&](int i) { return readPoint(L_, i, what(p), 2); });
      default:
        break;
    }
    return readOne(p, next_++);
  }

  // What a flat shape, of which z says nothing, has in the place of z that is left out.
  static Vec3E raised(const Parameter& p, const Vec3E& v) { return {v.x, v.y, isSize(p) ? 1.0 : 0.0}; }

  // A vector of a flat shape: z may be left out.
  Vec3E readInPlane(const Parameter& p, int at) {
    if (p.isTurn && isNumeric(L_, at)) return {0.0, 0.0, readNumber(L_, at, what(p), dependsOf(p))};
    if (p.isTurn || vectorSize(L_, at) == 3)
      return (isSize(p) ? readSize : readVector)(L_, at, what(p), 3, dependsOf(p));
    return raised(p, readVector(L_, at, what(p), 2, dependsOf(p)));
  }

  const Shape& shapeAt(const Parameter& p, int at) {
    if (!testShape(L_, at) && at == 1)
      raise(L_, what(p) + " must be a shape, got " + describe(L_, at) + "; write " + usageOf(entry_) +
                    " or shape:" + entry_.name + "(…)");
    const Shape& shape = readShape(L_, at, what(p));
    if (!shape.formulaAt.empty() && slopeOf(shape) > steepest_)
      formulaAt_ = shape.formulaAt, takesLipschitz_ = shape.takesLipschitz, steepest_ = slopeOf(shape);
    if (shape.claim.kind > weakest_) weakest_ = shape.claim.kind, inexactSince_ = shape.inexactSince;
    flat_ = flat_ || shape.dimension == 2;
    return shape;
  }

  bool isPoint(int at) const {
    if (isNamedVector(L_, at)) return true;
    if (!lua_istable(L_, at) || lua_rawlen(L_, at) != 2) return false;
    const bool numbers = lua_rawgeti(L_, at, 1) != LUA_TTABLE;
    lua_pop(L_, 1);
    return numbers;
  }

  template <class T, class Test, class Read>
  std::vector<T> takeWhile(Test test, Read read) {
    std::vector<T> list;
    for (; next_ <= last_ && test(); ++next_) list.push_back(read(next_));
    return list;
  }

  template <class T, class Read>
  std::vector<T> readList(const Parameter& p, int at, const char* wanted, Read read) {
    std::vector<T> list;
    forEachIn(L_, at, what(p), wanted, [&](int i) { list.push_back(read(i)); });
    return list;
  }

  static int numbersOf(const Parameter& p) {
    switch (p.kind) {
      case ArgumentKind::Number:
      case ArgumentKind::Integer:
        return 1;
      case ArgumentKind::Vector2:
      case ArgumentKind::Vector3:
        return sizeOf(p);
      default:
        return 0;
    }
  }

  // Of a size, one number stands for all components unless there are enough numbers in a row for this vector
  // and for the required parameters after it.
  Argument readSpreadVector(const Parameter& p, int size) {
    int run = 0;
    while (next_ + run <= last_ && isNumeric(L_, next_ + run)) ++run;
    int needed = 0, possible = 0;  // numbers that the parameters after it take
    for (const Parameter* q = &p + 1; q <= &entry_.parameters.back(); ++q) {
      if (q->required && numbersOf(*q) == 1) ++needed;
      possible += numbersOf(*q);
    }
    const bool spread = run >= size && (!isSize(p) || run >= size + needed);
    const bool tooMany = !spread && run > 1 && (!isSize(p) || run - 1 > possible);
    if (tooMany && run == 2 && flat_ && !p.isTurn) return raised(p, readSpread(p, 2));
    if (tooMany && flat_ && p.isTurn)
      raise(L_, what(p) + " takes one number, for a flat shape turns about z only");
    if (tooMany)
      raise(L_, what(p) + " takes three numbers" + (isSize(p) ? " or one for all" : "") +
                    ", got two; the third is missing");
    return spread ? readSpread(p, size) : readOne(p, next_++);
  }

  Vec3E readSpread(const Parameter& p, int size) {
    Vec3E v;
    Expr* components[] = {&v.x, &v.y, &v.z};
    for (int i = 0; i < size; ++i) *components[i] = readNumber(L_, next_++, what(p), dependsOf(p));
    return v;
  }

  static constexpr int kMostArguments = 100'000;

  lua_State* L_;
  const CatalogEntry& entry_;
  int next_ = 1;           // the first argument in place that no parameter has taken
  int last_ = 0;           // the last argument in place
  std::string formulaAt_;  // of the steepest formula among the arguments
  bool takesLipschitz_ = false;
  double steepest_ = 0.0;
  bool flat_ = false;  // is one of the shapes that were read flat?
  // The weakest claim that a shape among the arguments makes, and what made it.
  ClaimKind weakest_ = ClaimKind::Exact;
  std::string inexactSince_;
  int options_ = 0;  // the table of named fields, or 0; what lies above it is scratch
};

// A shape of the script's own formula.
int pushFormulaShape(lua_State* L, const std::string& what, Shape shape) {
  shape.inexactSince = what + " in line " + std::to_string(currentLine(L));
  if (slopeOf(shape) > 1.0 && shape.formulaAt.empty()) {
    shape.formulaAt = contextOf(L).file + ":" + std::to_string(currentLine(L));
    shape.takesLipschitz = what == "field";
  }
  return pushGood(L, std::move(shape));
}

int callEntry(lua_State* L) {
  const auto* entry = static_cast<const CatalogEntry*>(lua_touserdata(L, lua_upvalueindex(1)));
  return pushShape(L, Call(L, *entry).run()), 1;
}

// Some names mean a function of numbers as well, which is the second upvalue: round(2.5), round(shape, 0.1).
int callEntryOrNumberFunction(lua_State* L) {
  if (!isNumeric(L, 1)) return callEntry(L);
  lua_pushvalue(L, lua_upvalueindex(2));
  lua_insert(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

// The catalog's displacement has a pattern of its own; a function or a formula takes its place.
int callDisplace(lua_State* L) {
  const bool free = lua_isfunction(L, 2) || (isFormula(L, 2) && dependsOnSpace(exprAt(L, 2)));
  if (!testShape(L, 1) || lua_gettop(L) != 2 || !free) return callEntry(L);
  if (isMissing(*testShape(L, 1))) return pushShape(L, *testShape(L, 1)), 1;
  return pushFormulaShape(L, "displace",
                          displace(*testShape(L, 1), readFormula(L, 2, "displace: the formula")));
}

void pushEntryFunction(lua_State* L, const CatalogEntry& entry) {
  const auto& numbers = formulaLibrary();
  const bool shared = std::ranges::find(numbers, entry.name, &FunctionInfo::name) != numbers.end();
  lua_pushlightuserdata(L, const_cast<CatalogEntry*>(&entry));
  if (shared) lua_getglobal(L, entry.name.c_str());
  if (shared)
    lua_pushcclosure(L, guarded<callEntryOrNumberFunction>, 2);
  else
    lua_pushcclosure(L, entry.name == "displace" ? guarded<callDisplace> : guarded<callEntry>, 1);
}

struct ShapeSign {
  const char* event;
  const char* sign;
  const char* entry;
};
constexpr ShapeSign kShapeSigns[] = {{"__bor", "|", "union"},
                                     {"__band", "&", "intersection"},
                                     {"__sub", "-", "difference"},
                                     {"__bxor", "~", "xor"}};

int applySign(lua_State* L) {
  const auto& s = *static_cast<const ShapeSign*>(lua_touserdata(L, lua_upvalueindex(1)));
  for (int i = 1; i <= 2; ++i)
    if (!testShape(L, i))
      raise(L, std::string("'") + s.sign + "' needs a shape on both sides, got " + describe(L, i));
  return pushShape(L, Call(L, *findEntry(s.entry)).run()), 1;
}

// What is stated is trusted: rays step over what is steeper, and meshes lack it. One call may be run often.
void noteSteepness(lua_State* L, const std::string& name, const SteepPlace& steep, double stated) {
  ScriptContext& c = contextOf(L);
  const std::string place = c.file + ":" + std::to_string(currentLine(L)) + ": " + name + ": ";
  const auto isOfHere = [&](const std::string& note) { return note.starts_with(place); };
  if (std::ranges::any_of(c.scene.notes, isOfHere)) return;
  c.scene.notes.push_back(place + "the formula's slope is " + shown(steep.slope) + " at (" +
                          shown(steep.at.x) + ", " + shown(steep.at.y) + ", " + shown(steep.at.z) +
                          "), more than the lipschitz of " + shown(stated) +
                          " that is stated: parts of it may be missing; state a larger one, or leave it out");
}

int freeForm(lua_State* L) {
  expectArguments(L, 1, 2);
  const FunctionInfo& f = runningFunction(L);
  const Expr distance = readFormula(L, 1, f.name + ": the formula");
  const FieldValues known = readFields(L, 2, f);
  const Box bounds = valueOr(known, "bounds", Box::everything());
  const double lipschitz = valueOr(known, "lipschitz", kInfinity);
  if (const auto steep = steeperThan(distance, bounds, lipschitz))
    noteSteepness(L, f.name, *steep, lipschitz);
  return pushFormulaShape(L, f.name, field(distance, bounds, lipschitz));
}

int importedMesh(lua_State* L) {
  expectArguments(L, 1, 2);
  const FunctionInfo& f = runningFunction(L);
  ScriptContext& c = contextOf(L);
  const std::string name = readText(L, 1, f.name + ": the file");
  const FieldValues given = readFields(L, 2, f);
  const int voxels = valueOr(given, "voxels", 128);
  if (const Status s = MeshField::checkVoxels(voxels); !s) raise(L, f.name + ": " + s.error().message);
  const auto file = permitted(name, c.file, c.options, f.name);
  if (!file) return pushMissing(L, file.error().message);
  addOnce(c.scene.files, file->string());
  const auto began = std::chrono::steady_clock::now();
  const auto read = meshField(*file, voxels, c.options.meshCache);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  if (took > c.slowestRead) c.slowestRead = took, c.slowestMesh = name;
  if (!read) return pushMissing(L, read.error().message);
  if (!read->note.empty()) addOnce(c.scene.notes, name + ": " + read->note);
  return pushGood(L, triangleSolid(read->field));
}

int notArithmetic(lua_State* L) {
  raise(L,
        "shapes are combined with | (union), & (intersection), - (difference) and ~ (xor); moved with "
        "translate, sized with scale");
}

// A shape that is called: its distance at a place, a formula even where it is a constant, for its numbers may
// come from parameters.
int distanceOfShape(lua_State* L) {
  const Shape& shape = *testShape(L, 1);
  const int size = shape.dimension, given = lua_gettop(L) - 1;
  const std::string usage = size == 2 ? "shape(x, y)" : "shape(x, y, z)";
  if (isMissing(shape)) raise(L, *shape.error);
  if (given == 1 && lua_istable(L, 2))
    return pushFormula(L, distanceAt(shape, readVector(L, 2, usage, size, Depends::OnPosition))), 1;
  if (given != size)
    raise(L, "a shape that is called gives its distance at a place; write " + usage + ", got " +
                 std::to_string(given) + (given == 1 ? " argument" : " arguments"));
  Vec3E place{0.0, 0.0, 0.0};
  Expr* const components[] = {&place.x, &place.y, &place.z};
  for (int i = 0; i < size; ++i)
    *components[i] = readNumber(L, 2 + i, usage + ": '" + "xyz"[i] + "'", Depends::OnPosition);
  return pushFormula(L, distanceAt(shape, place)), 1;
}

// Two corners of a box that holds the shape; of a flat shape those of a rectangle. What parameters and the
// clock change has a box for their present values: the script runs again where that is not known yet, and for
// others.
int boundsOfShape(lua_State* L) {
  const Shape* shape = testShape(L, 1);
  if (!shape || lua_gettop(L) != 1)
    raise(L, "bounds: write local low, high = shape:bounds(), got " + describe(L, shape ? 2 : 1));
  if (isMissing(*shape)) raise(L, *shape->error);
  ScriptContext& c = contextOf(L);
  for (const std::string& input : noteValuesRead(c, shape->distance))
    if (!c.options.narrowed.contains(input)) c.toNarrow.insert(input);
  for (const glm::dvec3& corner : {shape->bounds.min, shape->bounds.max}) {
    pushResult(L, Vec3E(corner));
    if (shape->dimension == 3) continue;
    lua_pushnil(L);
    lua_rawseti(L, -2, 3);
  }
  return 2;
}

}  // namespace

void openCatalog(lua_State* L) {
  pushShapeMethods(L);
  for (const CatalogEntry& entry : catalog()) {
    pushEntryFunction(L, entry);
    const auto takesShapes = [](const Parameter& p) {
      return p.kind == ArgumentKind::Shape || p.kind == ArgumentKind::Shapes;
    };
    if (!entry.parameters.empty() && takesShapes(entry.parameters.front())) {
      lua_pushvalue(L, -1);
      lua_setfield(L, -3, entry.name.c_str());
    }
    lua_setglobal(L, entry.name.c_str());
  }
  lua_getglobal(L, "paint");
  lua_setfield(L, -2, "paint");
  lua_pushcfunction(L, guarded<boundsOfShape>);
  lua_setfield(L, -2, "bounds");
  lua_pop(L, 1);
  for (const ShapeSign& s : kShapeSigns) {
    lua_pushlightuserdata(L, const_cast<ShapeSign*>(&s));
    lua_pushcclosure(L, guarded<applySign>, 1);
    setShapeOperator(L, s.event);
  }
  lua_pushcfunction(L, guarded<distanceOfShape>);
  setShapeOperator(L, "__call");
  for (const char* event : {"__add", "__mul", "__div", "__unm", "__pow", "__mod", "__idiv"}) {
    lua_pushcfunction(L, guarded<notArithmetic>);
    setShapeOperator(L, event);
  }
}

// clang-format off
const std::vector<FunctionInfo>& shapeLibrary() {
  using enum SettingKind;
  static const std::vector<FunctionInfo> library{
      {"field",
       "field(function(x, y, z) return … end, {bounds = {{x0, y0, z0}, {x1, y1, z1}}, lipschitz = 2})",
       "solid where the formula is 0 or less",
       {{"bounds", SettingKind::Box, "a box that holds the solid; trusted", Rule::Any, {}, "none"},
        {"lipschitz", PlainNumber, "a bound on the formula's slope, within the bounds if there are some; trusted. Without one, sdfview derives it within the bounds, and refuses the field where it cannot; sdf2gltf meshes any field, but slowly where no slope is known", Rule::Positive, {}, "derived"}},
       freeForm},
      {"mesh",
       "mesh(\"bunny.glb\", {voxels = 128})",
       "the solid that the triangles of a file enclose: .glb, .gltf, .obj, .stl or .ply, in the scene's folder or below it, or in one that `--allow-dir` names. Holes are closed. An edge has at most 2,000 triangles. Its distance is exact; `sdfview` reads it from samples",
       {{"voxels", Integer, "how fine the samples of `sdfview` are: so many along the longest side, from 16 to 1024", Rule::Positive, {}, "128"}},
       importedMesh},
      {"text",
       "text(\"SDF\", {font = \"DejaVu Sans\", size = 1, align = \"left\"})",
       "flat letters, to be extruded; `\\n` begins a line. The first line stands on y = 0. Kerning, ligatures and the direction of a line are those of its script. Exact to the letters' outlines within 1e-6 of the font's size, and drawn by `sdfview` within 1e-4; letters that overlap are one",
       {{"font", Text, "a font's file (.ttf, .otf, .ttc, .otc, .woff, .woff2) in the scene's folder or below it, or in one that `--allow-dir` names; or a family that the machine has, as `\"DejaVu Serif:bold\"`: another machine may have another font of that name, or none", Rule::Any, {}, "\"DejaVu Sans\""},
        {"size", SettingKind::Number, "the font's size, its em; capitals have some 0.7 of it", Rule::Positive, {}, "1"},
        {"align", Choice, "of the lines, at x = 0", Rule::Any, {"left", "center", "right"}, "\"left\""},
        {"spacing", PlainNumber, "more room between letters, in sizes of the font; there are no ligatures then", Rule::Any, {}, "0"},
        {"line_spacing", PlainNumber, "from one line to the next, in what the font says", Rule::Any, {}, "1"}},
       textShape},
      {"path",
       "path(\"M 0 0 L 2 0 Q 2 1 0 1 Z\", {rule = \"nonzero\", stroke = 0.1})",
       "a flat shape that lines and curves enclose, written as in an SVG's `d`: `M x y` begins, `L x y`, `H x` and `V y` draw lines, `Q` and `C` Bézier curves, `T` and `S` smooth ones, `A rx ry turn large sweep x y` arcs of ellipses, `Z` closes. Small letters are relative to where the pen is. y is up. Lines and curves may cross; what is open is closed by a line. With a `stroke` it is a line along them instead, and what is open stays so. Exact within 1e-6 of the longest side of all its points, and drawn by `sdfview` within 1e-4",
       {{"rule", Choice, "what is inside where contours lie in one another: what they wind around, or every other", Rule::Any, {"nonzero", "evenodd"}, "\"nonzero\""},
        {"stroke", PlainNumber, "the width of a line along the path; without it the path is filled", Rule::Positive, {}, "none"},
        {"join", Choice, "the corners of a stroke", Rule::Any, {"round", "miter", "bevel"}, "\"round\""},
        {"cap", Choice, "the ends of a stroke", Rule::Any, {"round", "butt", "square"}, "\"round\""},
        {"dash", PlainNumber, "the length of dashes in a stroke, from where each piece of the path begins; 0: dots, where the ends are round or square", Rule::NotNegative, {}, "none"},
        {"gap", PlainNumber, "between two dashes", Rule::Positive, {}, "as `dash`"}},
       pathShape},
      {"svg",
       "svg(\"logo.svg\", {size = 1})",
       "what an SVG drawing fills and strokes, as one flat shape about the origin: paths, basic shapes, groups, transforms, `use`, fill rules, joins, ends and dashes of strokes, and styles by class. Text, pictures, clips and masks are not read: make text to paths. Files lie as those of `mesh` do. Exact within 1e-6 of the longest side of all its points, and drawn by `sdfview` within 1e-4",
       {{"size", SettingKind::Number, "of its longest side", Rule::Positive, {}, "1"}},
       svgShape},
      {"tube",
       "tube({{0, 0, 0}, {1, 1, 0}, {2, 0, 0}}, 0.2, {curve = true})",
       "all points within a radius of a line through these points, with round ends. For a straight line points may depend on parameters. In the place of the radius a list gives each point its own: `tube({{0, 0, 0}, {0, 2, 0}}, {0.3, 0.1})`. Exact outside",
       {{"curve", Flag, "is the line smooth? It is made of arcs, two from point to point: points of a circle give the circle", Rule::Any, {}, "false"},
        {"closed", Flag, "does it lead back to the first point?", Rule::Any, {}, "false"}},
       tubeShape},
      {"struts",
       "struts({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 2}, {2, 3}}, 0.1)",
       "round struts of a radius between pairs of points, which are given by their numbers in the list of points. Exact outside",
       {},
       strutsShape},
  };
  return library;
}
// clang-format on

}  // namespace sdf
