// Deformed solids as meshes: a mesh of the plain solid whose vertices went where the deformation's definition
// takes them.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "operator_meshes.h"
#include "sdf/shape/shape.h"

namespace sdf::accuracy {

/// A point of a surface and the unit normal there, outward.
struct SurfacePoint {
  glm::dvec3 at{0.0}, normal{0.0};
};

/// A solid before it is deformed: with a distance of its own, and a fine mesh.
struct Part {
  std::string text;  ///< as a scene file says it
  Shape shape;
  TriangleMesh mesh;
  std::function<double(const glm::dvec3&)> distance;  ///< in closed form, from its definition
  /// The point within it whose rays meet the surface near p once.
  std::function<glm::dvec3(const glm::dvec3&)> core;
  double half = 0.0;  ///< its smallest half size
};
struct NamedPart {
  std::string name;
  Part (*make)();
};
/// A box, a sphere and a torus off the axis, a cylinder and a column over a star.
const std::vector<NamedPart>& deformedParts();

/// A part on its way through deformations: `mesh` was moved vertex by vertex, `map` takes a point of the
/// part's surface to the same place.
struct Deformed {
  std::string text;
  Shape shape;
  TriangleMesh mesh;
  std::function<SurfacePoint(const SurfacePoint&)> map;
  double half = 0.0;
  /// How much more the maps so far stretch one direction than another, at most: a product over the maps.
  double unevenness = 1.0;
};
Deformed undeformed(const Part& part);
/// Each takes a point by `map`, which must keep left and right; what the library makes of it is `shape`, and
/// `thinner` is what becomes of the smallest half size.
Deformed deformedBy(const Deformed& d, std::string text, Shape shape, const PointMap& map, double thinner);
Deformed twisted(const Deformed& d, double degrees);
Deformed tapered(const Deformed& d, double rate);
Deformed bent(const Deformed& d, double degrees);
Deformed scaledBy(const Deformed& d, const glm::dvec3& factors);
/// Turned by a quarter about z, so that bend takes what stood along y.
Deformed laidDown(const Deformed& d);
/// The surface where the part's distance and amplitude sin(wx) sin(wy) sin(wz) add up to 0.
Deformed displaced(const Part& part, double amplitude, double frequency);

/// Points all over its surface, by chance.
std::vector<SurfacePoint> surfaceOf(const Part& part, const Deformed& d, int count, unsigned seed);

struct Deformation {
  std::string name;
  bool moderate;
  Deformed (*of)(const Part&);
};
const std::vector<Deformation>& deformations();

/// The deformed solid with its true distance, and points of its surface.
class DeformedSolid {
 public:
  DeformedSolid(const Part& part, Deformed deformed, unsigned seed);

  /// How far along the normal, either way, s stays the nearest point of the surface, and how far the next
  /// sharp edge is: the lesser.
  struct Sample : SurfacePoint {
    double room = 0.0;
  };
  struct Place {
    glm::dvec3 at{0.0};
    double distance = 0.0;  ///< signed
    double toEdge = 0.0;    ///< distance to the nearest sharp edge
  };

  const std::string& text() const { return deformed_.text; }
  const Shape& shape() const { return deformed_.shape; }
  double half() const { return deformed_.half; }
  /// The longest side of the mesh's bounds.
  double size() const { return box_.longestSide(); }
  const Box& box() const { return box_; }
  Place place(const glm::dvec3& p) const { return {p, reference_.signedDistance(p), toEdge(p)}; }
  /// As in Deformed.
  double unevenness() const { return deformed_.unevenness; }
  /// The largest distance from a sample, which lies on the surface, to the mesh.
  double chord() const { return chord_; }
  /// Uniform over the surface, edges and all; then those about the roomiest.
  const std::vector<Sample>& samples() const { return samples_; }
  /// One of those with most room.
  const Sample& roomiest() const { return samples_[roomiest_]; }
  /// Around the solid and near its surface.
  const std::vector<Place>& places() const { return places_; }

 private:
  double toEdge(const glm::dvec3& p) const;
  Sample sampleAt(const SurfacePoint& s) const;

  Deformed deformed_;
  Reference reference_;
  Box box_;
  double chord_ = 0.0;
  std::vector<glm::dvec3> edges_;  ///< points of them, as dense as the mesh
  std::vector<Sample> samples_;
  std::size_t roomiest_ = 0;
  std::vector<Place> places_;
};

}  // namespace sdf::accuracy
