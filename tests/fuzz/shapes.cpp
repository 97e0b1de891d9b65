#include "fuzz/shapes.h"

#include <string>

#include "fuzz/targets.h"
#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/operators/deform.h"

namespace sdf::fuzz {
namespace {

class ShapeReader {
 public:
  explicit ShapeReader(Bytes& bytes) : bytes_(bytes) {}

  FuzzedShape read(int most) {
    for (int left = 1 + bytes_.below(most); left > 0 && !bytes_.empty(); --left) step();
    std::vector<Shape> solids;
    for (const Shape& s : made_) solids.push_back(s.dimension == 2 ? extrude(s, 0.5) : s);
    return {solids.empty() ? Shape::failed("no shape") : unite(solids), moderate_};
  }

 private:
  void step() {
    const CatalogEntry& entry = catalog()[bytes_.below(static_cast<int>(catalog().size()))];
    std::vector<Argument> arguments;
    taken_ = 0;
    for (const Parameter& p : entry.parameters) arguments.push_back(argument(p));
    Shape shape = build(entry, arguments);
    if (!shape.ok()) {
      if (shape.error->empty() || shape.error->find('\n') != std::string::npos)
        find(entry.name + " fails without one line that says why: '" + *shape.error + "'");
      return;
    }
    made_.resize(made_.size() - taken_);
    if (bytes_.below(4) == 0)
      shape =
          shape.paint({.color = {Expr(bytes_.positive() / 4.0), Expr(bytes_.positive() / 4.0), Expr(0.5)}});
    made_.push_back(std::move(shape));
  }

  // Angles and rates are in degrees.
  double scaleOf(const Parameter& p) {
    const bool turns = p.name.starts_with("angle") || p.name == "rate";
    return turns ? 32.0 : 1.0;
  }
  Expr number(const Parameter& p) {
    if (bytes_.below(32) == 0) {
      moderate_ = false;
      return Expr(bytes_.number());
    }
    const double v =
        p.rule == Rule::Positive || p.rule == Rule::NotNegative ? bytes_.positive() : bytes_.moderate();
    return Expr(v * scaleOf(p));
  }

  Argument argument(const Parameter& p) {
    const bool standard = bytes_.below(4) == 0 && (!p.required || !p.fallback.empty());
    if (standard) return std::monostate{};
    switch (p.kind) {
      case ArgumentKind::Number:
        return number(p);
      case ArgumentKind::Integer:
        return static_cast<int>(bytes_.below(12));
      case ArgumentKind::Vector2:
        return Vec3E{number(p), number(p), 0.0};
      case ArgumentKind::Vector3:
        if (p.name == "count")
          return Vec3E{1.0 + bytes_.below(4), 1.0 + bytes_.below(4), 1.0 + bytes_.below(4)};
        return Vec3E{number(p), number(p), number(p)};
      case ArgumentKind::Choice:
        return bytes_.below(static_cast<int>(p.choices.size()));
      case ArgumentKind::Points: {
        std::vector<glm::dvec2> points;
        for (int left = 3 + bytes_.below(6); left > 0; --left)
          points.emplace_back(bytes_.moderate(), bytes_.moderate());
        return points;
      }
      case ArgumentKind::Shape:
        return take();
      case ArgumentKind::Shapes:
        break;
    }
    std::vector<Shape> several;
    for (int left = 1 + bytes_.below(3); left > 0; --left) several.push_back(take());
    return several;
  }

  // The shapes made last are used first. Where none is left, a box.
  Shape take() {
    if (taken_ < made_.size()) return made_[made_.size() - ++taken_];
    return build(*findEntry("box"), {});
  }

  Bytes& bytes_;
  std::vector<Shape> made_;
  bool moderate_ = true;
  std::size_t taken_ = 0;  // by the entry that is being built, from the end of made_
};

}  // namespace

FuzzedShape readShape(Bytes& bytes, int most) { return ShapeReader(bytes).read(most); }

}  // namespace sdf::fuzz
