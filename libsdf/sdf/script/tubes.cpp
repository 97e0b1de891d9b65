#include "sdf/script/tubes.h"

#include <lua.hpp>

#include "sdf/script/library.h"
#include "sdf/shape/operators/tubes.h"

namespace sdf {

namespace {

// The name of a point after so many others, which is no number.
std::string pointAt(lua_State* L, int index, const FunctionInfo& f, std::size_t others) {
  const std::string what = f.name + ": point " + std::to_string(others + 1);
  if (isNumeric(L, index))
    raise(L, what + " must be {x, y, z}, got " + describe(L, index) + "; write " + f.usage);
  return what;
}

// Pushes what stands in the place of parts that the script does not name.
int pushTube(lua_State* L, const FunctionInfo& f, Shape shape) {
  if (shape.claim.kind != ClaimKind::Exact)
    shape.inexactSince = f.name + " in line " + std::to_string(currentLine(L));
  return pushGood(L, std::move(shape));
}

// read(place on the stack, name) gives a point.
template <class Read>
auto pointsAt(lua_State* L, const FunctionInfo& f, const Read& read) {
  std::vector<decltype(read(0, std::string()))> points;
  forEachIn(L, 1, f.name + ": the points", "a list of points {{x, y, z}, …}",
            [&](int at) { points.push_back(read(at, pointAt(L, at, f, points.size()))); });
  return points;
}

std::vector<glm::dvec3> fixedPoints(lua_State* L, const FunctionInfo& f) {
  return pointsAt(L, f, [&](int at, const std::string& what) { return readPoint(L, at, what, 3); });
}

std::vector<Vec3E> movingPoints(lua_State* L, const FunctionInfo& f) {
  return pointsAt(L, f, [&](int at, const std::string& what) {
    return readVector(L, at, what, 3, Depends::OnParameters);
  });
}

Expr radiusAt(lua_State* L, int index, const FunctionInfo& f, const std::string& which = "the radius") {
  return readNumber(L, index, f.name + ": " + which, Depends::OnParameters);
}

}  // namespace

int tubeShape(lua_State* L) {
  expectArguments(L, 2, 3);
  const FunctionInfo& f = runningFunction(L);
  const FieldValues given = readFields(L, 3, f);
  const bool isCurve = valueOr(given, "curve", false), isClosed = valueOr(given, "closed", false);
  if (!lua_istable(L, 2)) {
    const Expr radius = radiusAt(L, 2, f);
    return pushTube(L, f,
                    isCurve ? curvedTube(fixedPoints(L, f), radius, isClosed)
                            : tube(movingPoints(L, f), radius, isClosed));
  }
  if (isCurve) raise(L, f.name + ": along a curve the radius is one number");
  std::vector<Expr> radii;
  forEachIn(L, 2, f.name + ": the radii", "a list of numbers", [&](int at) {
    radii.push_back(radiusAt(L, at, f, "radius " + std::to_string(radii.size() + 1)));
  });
  return pushTube(L, f, taperedTube(fixedPoints(L, f), radii, isClosed));
}

int strutsShape(lua_State* L) {
  expectArguments(L, 3, 3);
  const FunctionInfo& f = runningFunction(L);
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  const std::string wanted = "a pair of points' numbers {1, 2}";
  forEachIn(L, 2, f.name + ": the edges", "a list of pairs {{1, 2}, …}", [&](int at) {
    const std::string edge = f.name + ": edge " + std::to_string(edges.size() + 1);
    std::vector<std::size_t> ends;
    forEachIn(L, at, edge, wanted.c_str(), [&](int end) {
      const int number = readInteger(L, end, edge);
      if (number < 1) raise(L, edge + " counts points from 1, got " + std::to_string(number));
      ends.push_back(static_cast<std::size_t>(number) - 1);
    });
    if (ends.size() != 2) raise(L, edge + " must be " + wanted + ", got " + describe(L, at));
    edges.emplace_back(ends[0], ends[1]);
  });
  return pushTube(L, f, struts(movingPoints(L, f), edges, radiusAt(L, 3, f)));
}

}  // namespace sdf
