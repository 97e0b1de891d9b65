// Polygons of many sides, and outlines of arcs, as functions of a point. Private to shape/.
#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "sdf/expr/payload.h"
#include "sdf/shape/solids/polygon_cells.h"
#include "sdf/shape/solids/polygon_tree.h"

namespace sdf {

/// The signed distance to contours in the plane of the first two arguments; the third one is not read. Its
/// slope is 1; over a box it is the value in the middle, more or less half the diagonal; shaders read it from
/// PolygonCells.
class PolygonField : public Payload {
 public:
  /// The field of these contours (see PolygonDistance), the same one as long as there is one. Shaders read
  /// others in their place where some are `drawn`. Cost: n.
  static std::shared_ptr<const PolygonField> of(std::vector<ArcContour> contours,
                                                std::vector<ArcContour> drawn = {});
  /// That of a polygon's corners.
  static std::shared_ptr<const PolygonField> of(std::span<const glm::dvec2> corners);

  const PolygonDistance& distance() const { return distance_; }
  /// What shaders read, made when it is first asked for.
  const PolygonCells& cells() const;

  double value(const glm::dvec3& p) const override;
  ValueAndGradient gradient(const glm::dvec3& p) const override;
  Interval range(const std::array<Interval, 3>& box) const override;
  double lipschitz() const override { return 1.0; }
  bool hasCreases() const override { return true; }
  double rounding(const glm::dvec3& p) const override;
  void values(const PayloadRows& p, std::size_t count, float* out) const override;
  void gradients(const PayloadRows& p, std::size_t count, const std::array<float*, 4>& out) const override;
  std::string glsl(const std::string& name) const override {
    return PolygonCells::glsl(name, drawn().hasArcs());
  }
  std::span<const PayloadVolume> volumes() const override { return {&cells().volume, 1}; }
  std::string_view kind() const override { return drawn().hasArcs() ? "outline" : "polygon"; }

 private:
  PolygonField(std::vector<ArcContour> contours, std::vector<ArcContour> drawn);
  const PolygonDistance& drawn() const { return drawnDistance_ ? *drawnDistance_ : distance_; }

  std::vector<ArcContour> contours_, drawn_;
  PolygonDistance distance_;
  std::optional<PolygonDistance> drawnDistance_;
  mutable std::once_flag made_;
  mutable std::optional<PolygonCells> cells_;
};

}  // namespace sdf
