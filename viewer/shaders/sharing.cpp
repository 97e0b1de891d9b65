#include "viewer/shaders/sharing.h"

#include <algorithm>

#include "sdf/expr/gradient.h"
#include "sdf/expr/hoist.h"
#include "sdf/model/model.h"

namespace sdf::viewer {
namespace {

constexpr std::size_t kLongGradients = 2000;  // operations, which drivers take seconds to compile

// What the loops over the kinds start from.
std::vector<NumberedOperand> othersAndDrawn(const Plan& plan) {
  std::vector<NumberedOperand> operands = plan.kinds->others;
  for (const DrawnMesh& mesh : plan.drawn) operands.push_back(mesh.operand);
  std::ranges::sort(operands, {}, &NumberedOperand::number);
  return operands;
}

// And where the half spaces are to be read, too.
std::vector<NumberedOperand> othersAndPlanes(const Plan& plan) {
  std::vector<NumberedOperand> operands = othersAndDrawn(plan);
  const std::vector<NumberedOperand> planes = operandsOf(plan.planes);
  operands.insert(operands.end(), planes.begin(), planes.end());
  std::ranges::sort(operands, {}, &NumberedOperand::number);
  return operands;
}

Marched besideOf(const Plan& plan) { return leastOf(othersAndPlanes(plan), plan.options.steps); }

// Whether some of what the loops over the kinds read has a step that is not its distance.
bool areApart(const Plan& plan) {
  return std::ranges::any_of(plan.kinds->many, hasOwnStep<OperandKind>) ||
         (!othersAndPlanes(plan).empty() && hasOwnStep(besideOf(plan)));
}

std::vector<Expr> outputsOf(const Marched& m) { return hasOwnStep(m) ? partsOf(m) : std::vector{m.distance}; }

/// Writes the loops over the kinds' groups. What is least is a float where the distance of all is their step,
/// else a vec2 of the step and the distance.
class Loops {
 public:
  Loops(const Plan& plan, const RowWriter& rows, GlslWriter& writer)
      : plan_(plan), rows_(rows), writer_(writer), apart_(areApart(plan)), type_(apart_ ? "vec2" : "float") {}

  const std::string& type() const { return type_; }
  /// A term for what a function gives, which is a vec3 if the step and the distance differ.
  std::string read(bool isVector, const std::string& function) const {
    return isVector ? function + "(p, n).xy" : type_ + "(" + function + "(p, n))";
  }
  std::string start() const { return plan_.cells ? cellOf() : ""; }
  std::string begin() const;
  std::string search(std::size_t i) const;
  std::string loop(std::size_t i) const;

 private:
  const OperandKind& kind(std::size_t i) const { return plan_.kinds->many[i]; }
  std::string distance() const { return apart_ ? "least.y" : "least"; }
  std::string cellOf() const;
  std::string rowAt(std::size_t i) const;
  std::string stride(std::size_t i) const;

  const Plan& plan_;
  const RowWriter& rows_;
  GlslWriter& writer_;
  bool apart_;
  std::string type_;
};

// A term for where the row begins that is named at `at`.
std::string Loops::rowAt(std::size_t i) const {
  return plan_.cells && !rows_.rangeOf(i).isInLists() ? "int(sdfTexel(at).x)" : "at";
}

// From one group to the next in a loop.
std::string Loops::stride(std::size_t i) const {
  const RowRange& rows = rows_.rangeOf(i);
  return std::to_string(plan_.cells ? rows.listed() : rows.stride);
}

// What looks for the next group, from the one at `at` on, that is near enough to its bounds to lessen what is
// least.
std::string Loops::search(std::size_t i) const {
  const std::string name = std::to_string(i);
  const std::string head = "int sdfNext" + name + "(vec3 p, int at, int end, " + type_ + " least) {\n";
  if (kind(i).gap.isConstant()) return head + "  return at;\n}\n";
  const auto share = [&](double growth) { return number(growth < kInfinity ? 1.0 / growth : 0.0, writer_); };
  std::string isFar = "gap * " + share(kind(i).growth) + " >= " + distance();
  if (apart_) isFar += " && gap * " + share(kind(i).stepGrowth) + " >= least.x";
  return rows_.takingFirst(i, kind(i).gapNumbers, "Gap" + name) + head +
         "  for (; at < end; at += " + stride(i) + ") {\n    sdfTakeGap" + name + "(" + rowAt(i) +
         ");\n    float gap = sdfGap" + name + "(p, vec3(0.0));\n    if (!(gap > 0.0 && " + isFar +
         ")) break;\n  }\n  return at;\n}\n";
}

// The number of the cell of p, and how far p is at least from all bounds; where that is far, the cell is the
// one that lists nothing if no more is asked for. Powers of two are taken from a float's exponent, so that
// every machine finds the same level.
std::string Loops::cellOf() const {
  const CellGrid& grid = plan_.cells->grid();
  const auto whole = [&](int i) { return "int(" + number(i, writer_) + ")"; };
  std::string sides, firsts;
  for (int i = 0; i < CellGrid::kLevels; ++i) {
    const CellGrid::Level& level = grid.levels[static_cast<std::size_t>(i)];
    const std::string where = i + 1 < CellGrid::kLevels ? "level == " + std::to_string(i) + " ? " : "";
    const std::string other = i + 1 < CellGrid::kLevels ? " : " : "";
    sides += where + "ivec3(" + vector(level.side, writer_) + ")" + other;
    firsts += where + whole(level.first) + other;
  }
  const auto& [half, size, side, first] = grid.levels.front();
  const std::string count = std::to_string(CellGrid::kLevels), last = whole(grid.cells() - 1);
  const std::string middle = vector(grid.middle, writer_), box = vector(half, writer_);
  const std::string margin = number(grid.margin, writer_), nowhere = whole(grid.cells());
  const std::string reach = number(grid.reach, writer_), turns = number(1.0 / grid.reach, writer_);
  return "int sdfCell(vec3 p, float enough, out float free) {\n  vec3 off = p - " + middle +
         ", beyond = abs(off) - " + box +
         ";\n  float far = max(beyond.x, max(beyond.y, beyond.z));\n  free = far + " + margin +
         ";\n  if (far > 0.0 && free >= enough) return " + nowhere +
         ";\n  free = 1e30;\n  int level = max((floatBitsToInt(1.0 + far * " + turns +
         ") >> 23) - 126, 0);\n  if (level >= " + count + ") return " + last +
         ";\n  float two = intBitsToFloat((127 + level) << 23);\n  vec3 at = (off + (" + box + " + " + reach +
         " * (two - 1.0))) * (" + number(1.0 / size, writer_) + " / two);\n  ivec3 side = " + sides +
         ", c = clamp(ivec3(at), ivec3(0), side - 1);\n  return (" + firsts +
         ") + (c.z * side.y + c.y) * side.x + c.x;\n}\n";
}

// The lists of all kinds in the cell of p: where each begins, and ends.
std::string Loops::begin() const {
  if (!plan_.cells) return "";
  const std::size_t count = cellTexels(plan_.cells->kinds());
  std::string text = "  float free;\n  int cell = " + std::to_string(rows_.texels()) + " + " +
                     std::to_string(count) + " * sdfCell(p, enough, free);\n  least = min(least, free);\n";
  for (std::size_t i = 0; i < count; ++i)
    text += "  vec4 lists" + std::to_string(i) + " = sdfTexel(cell + " + std::to_string(i) + ");\n";
  return text;
}

std::string Loops::loop(std::size_t i) const {
  const std::string name = std::to_string(i);
  const std::string list = "lists" + std::to_string(i / 2) + (i % 2 == 0 ? ".xy" : ".zw");
  const auto& [count, first, length] = rows_.rangeOf(i);
  const std::string all = std::to_string(first) + ", " + std::to_string(first + length * count);
  const std::string next = "sdfNext" + name + "(p, ", rest = ", span" + name + ".y, least)";
  const std::string term = read(hasOwnStep(kind(i)), "sdfKind" + name), d = apart_ ? "d.y" : "d";
  return "  ivec2 span" + name + " = ivec2(" + (plan_.cells ? list : all) + ");\n  for (int at = " + next +
         "span" + name + ".x" + rest + "; at < span" + name + ".y; at = " + next + "at + " + stride(i) +
         rest + ") {\n    sdfTake" + name + "(" + rowAt(i) + ");\n    " + type_ + " d = " + term +
         ";\n    float i = sdfNearest" + name + "(p, n);\n    if (" + d + " < " + distance() + " || (" + d +
         " == " + distance() + " && i > number)) {\n      number = i;\n      place = ivec2(" + name + ", " +
         rowAt(i) + ");\n    }\n    least = min(least, d);\n  }\n";
}

// Defines sdfNearest(p) where gradients are shared, else sdfOperand(p, n), the number alone.
std::string nearest(const Plan& plan, bool hasBeside, const std::string& beside) {
  if (!plan.gradients && plan.operands.empty()) return "";
  std::string text = (plan.gradients ? "vec4 sdfNearest(vec3 p) {\n  vec3 n = vec3(0.0);\n"
                                     : "float sdfOperand(vec3 p, vec3 n) {\n") +
                     std::string("  float number = ") + (hasBeside ? "sdfNearestBeside(p, n)" : "0.0") +
                     ";\n  ivec2 place = ivec2(-1);\n  sdfLeast(p, " + beside + ", number, place, 0.0);\n";
  if (!plan.gradients) return text + "  return number;\n}\n";
  if (hasBeside) text += "  if (place.x < 0) n = sdfGradientBeside(p, n);\n";
  for (std::size_t i = 0; i < plan.kinds->many.size(); ++i) {
    const std::string name = std::to_string(i);
    text += "  if (place.x == " + name + ") {\n    sdfTake" + name + "(place.y);\n    n = sdfGradient" +
            name + "(p, n);\n  }\n";
  }
  return text + "  return vec4(n, number);\n}\n";
}

}  // namespace

std::size_t gradientSize(const Expr& distance) {
  return topologicalOrder(partsOf(gradientOf(distance))).size();
}

std::vector<Expr> partsOf(const Marched& m) { return {m.step, m.distance, Expr(0.0)}; }

Marched marchedOf(const OperandKind& kind, const Box& bounds) {
  return {hoisted(kind.distance), hoisted(kind.step), bounds};
}

Marched leastOf(const std::vector<NumberedOperand>& operands, Steps steps) {
  std::vector<Steep> all;
  for (const NumberedOperand& operand : operands)
    all.push_back({operand.distance, operand.slope, operand.bounds, operand.copies});
  const Marchable least = sdf::leastOf(all, steps);
  return {hoisted(least.distance), hoisted(least.step)};
}

std::vector<NumberedOperand> operandsOf(const std::vector<HalfSpace>& planes) {
  std::vector<NumberedOperand> operands;
  for (const HalfSpace& plane : planes) operands.push_back(plane.operand);
  return operands;
}

// A group is read where its bounds are nearer than what has been found. The next one is looked for in a loop
// of its own: pixels that are drawn together then read together, each a group of its own.
std::string sharing(const Plan& plan, const RowWriter& rows, GlslWriter& writer) {
  const std::vector<NumberedOperand> others = othersAndDrawn(plan);
  const bool hasPlanes = !plan.planes.empty(), hasBeside = hasPlanes || !others.empty();
  const Loops write(plan, rows, writer);
  std::string searches = write.start(), loops = write.begin();
  for (std::size_t i = 0; i < plan.kinds->many.size(); ++i) {
    searches += write.search(i);
    loops += write.loop(i);
  }
  const auto from = [&](bool any, bool isVector, const std::string& function) {
    return any ? write.read(isVector, function) : write.type() + "(1e30)";
  };
  const std::string beside = from(hasBeside, hasBeside && hasOwnStep(besideOf(plan)), "sdfBeside");
  const auto both = [&](const std::string& name, const std::string& start) {
    return "vec2 " + name + "(vec3 p, float enough) {\n  vec3 n = vec3(0.0);\n  float number = 0.0;\n" +
           "  ivec2 place;\n  return vec2(sdfLeast(p, " + start + ", number, place, enough));\n}\n";
  };
  std::string text =
      searches + write.type() + " sdfLeast(vec3 p, " + write.type() +
      " least, inout float number, inout ivec2 place, float enough) {\n  vec3 n = vec3(0.0);\n" + loops +
      "  return least;\n}\n" + both("sdfBoth", beside) +
      "float sdfDistance(vec3 p, vec3 n) { return sdfBoth(p, 1e30).y; }\n";
  if (hasPlanes)
    text += both("sdfBothOfRest",
                 from(!others.empty(), !others.empty() && hasOwnStep(leastOf(others, plan.options.steps)),
                      "sdfOthers"));
  if (plan.bounces > 0 || !plan.grouped) text += nearest(plan, hasBeside, beside);
  return text;
}

bool sharesGradients(const Plan& plan) {
  std::size_t size = othersAndPlanes(plan).empty() ? 0 : gradientSize(besideOf(plan).distance);
  for (const OperandKind& kind : plan.kinds->many) size += gradientSize(kind.distance);
  return size <= kLongGradients;
}

Functions sharedFunctions(const Plan& plan) {
  Functions functions{
      {"sdfOthers", [&] { return outputsOf(leastOf(othersAndDrawn(plan), plan.options.steps)); }},
      {"sdfBeside", [&] { return outputsOf(besideOf(plan)); }},
      {"sdfGradientBeside", [&] { return partsOf(gradientOf(besideOf(plan).distance)); }},
      {"sdfNearestBeside", [&] { return std::vector{numberOfNearest(othersAndPlanes(plan))}; }}};
  for (std::size_t i = 0; i < plan.kinds->many.size(); ++i) {
    const OperandKind& kind = plan.kinds->many[i];
    functions["sdfKind" + std::to_string(i)] = [&] { return outputsOf(marchedOf(kind)); };
    functions["sdfGradient" + std::to_string(i)] = [&] {
      return partsOf(gradientOf(marchedOf(kind).distance));
    };
    functions["sdfGap" + std::to_string(i)] = [&] { return std::vector{kind.gap}; };
    functions["sdfNearest" + std::to_string(i)] = [&] { return std::vector{kind.nearest}; };
  }
  return functions;
}

}  // namespace sdf::viewer
