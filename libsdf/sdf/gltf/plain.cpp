// STL, PLY and OBJ through OpenMesh's writers.
#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// IOManager takes part in the writers' registration, so it comes before them.
#include <OpenMesh/Core/IO/writer/OBJWriter.hh>
#include <OpenMesh/Core/IO/writer/PLYWriter.hh>
#include <OpenMesh/Core/IO/writer/STLWriter.hh>
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "sdf/gltf/formats.h"

namespace sdf {
namespace {

namespace om = OpenMesh;

/// IEC 61966-2-1, for formats whose readers take colours as they would be shown.
float srgb(float linear) {
  const float v = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

/// Shows OpenMesh's writers the parts as one list of triangles. Its own half-edge mesh is not used, as that
/// drops triangles where more than two meet at an edge.
class Soup : public om::IO::BaseExporter {
 public:
  explicit Soup(const std::vector<ExportPart>& parts) {
    for (const ExportPart& part : parts) {
      const Mesh& mesh = part.mesh;
      const auto first = static_cast<std::uint32_t>(points_.size());
      const auto welded = [&](std::uint32_t i) {
        return first + (i < mesh.welded ? i : mesh.copyOf[i - mesh.welded]);
      };
      for (std::uint32_t i = 0; i < mesh.welded; ++i) {
        points_.push_back(toOpenMesh(mesh.positions[i]));
        normals_.push_back(toOpenMesh(mesh.normals[i]));
        const glm::vec3& c = mesh.colors[i];
        colors_.emplace_back(srgb(c.x), srgb(c.y), srgb(c.z));
      }
      for (const glm::uvec3& t : mesh.triangles)
        triangles_.push_back({welded(t.x), welded(t.y), welded(t.z)});
    }
  }

  om::Vec3f point(om::VertexHandle v) const override { return points_[v.idx()]; }
  om::Vec3d pointd(om::VertexHandle v) const override { return om::Vec3d(point(v)); }
  bool is_point_double() const override { return false; }
  om::Vec3f normal(om::VertexHandle v) const override { return normals_[v.idx()]; }
  om::Vec3d normald(om::VertexHandle v) const override { return om::Vec3d(normal(v)); }
  bool is_normal_double() const override { return false; }
  om::Vec3f colorf(om::VertexHandle v) const override { return colors_[v.idx()]; }
  om::Vec4f colorAf(om::VertexHandle v) const override { return withAlpha(colorf(v), 1.0f); }
  om::Vec3ui colori(om::VertexHandle v) const override {
    const auto byte = [](float c) { return static_cast<unsigned>(std::lround(c * 255.0f)); };
    const om::Vec3f& c = colors_[v.idx()];
    return {byte(c[0]), byte(c[1]), byte(c[2])};
  }
  om::Vec4ui colorAi(om::VertexHandle v) const override { return withAlpha(colori(v), 255u); }
  om::Vec3uc color(om::VertexHandle v) const override { return om::Vec3uc(colori(v)); }
  om::Vec4uc colorA(om::VertexHandle v) const override { return om::Vec4uc(colorAi(v)); }

  unsigned int get_vhandles(om::FaceHandle f, std::vector<om::VertexHandle>& corners) const override {
    corners.clear();
    const glm::uvec3& t = triangles_[f.idx()];
    for (int k = 0; k < 3; ++k) corners.emplace_back(static_cast<int>(t[k]));
    return 3;
  }
  om::Vec3f normal(om::FaceHandle f) const override {
    const glm::uvec3& t = triangles_[f.idx()];
    const om::Vec3d a(points_[t.x]), b(points_[t.y]), c(points_[t.z]);
    const om::Vec3d n = (b - a) % (c - a);
    const double length = n.norm();
    return length > 0.0 ? om::Vec3f(n / length) : om::Vec3f(0.0f);
  }
  om::Vec3d normald(om::FaceHandle f) const override { return om::Vec3d(normal(f)); }

  size_t n_vertices() const override { return points_.size(); }
  size_t n_faces() const override { return triangles_.size(); }
  size_t n_edges() const override { return 0; }
  bool is_triangle_mesh() const override { return true; }
  bool has_vertex_normals() const override { return true; }
  bool has_vertex_colors() const override { return true; }
  bool has_face_normals() const override { return true; }
  /// The PLY writer looks for custom properties here; an empty mesh has none.
  const om::BaseKernel* kernel() override { return &noProperties_; }

  // What follows belongs to features that no option of ours turns on.
  om::Vec2f texcoord(om::VertexHandle) const override { return om::Vec2f(0.0f); }
  om::Vec2f texcoord(om::HalfedgeHandle) const override { return om::Vec2f(0.0f); }
  om::Attributes::StatusInfo status(om::VertexHandle) const override { return {}; }
  om::HalfedgeHandle getHeh(om::FaceHandle, om::VertexHandle) const override { return om::HalfedgeHandle(); }
  unsigned int get_face_texcoords(std::vector<om::Vec2f>&) const override { return 0; }
  om::Vec3uc color(om::FaceHandle) const override { return om::Vec3uc(0); }
  om::Vec4uc colorA(om::FaceHandle) const override { return om::Vec4uc(0); }
  om::Vec3ui colori(om::FaceHandle) const override { return om::Vec3ui(0u); }
  om::Vec4ui colorAi(om::FaceHandle) const override { return om::Vec4ui(0u); }
  om::Vec3f colorf(om::FaceHandle) const override { return om::Vec3f(0.0f); }
  om::Vec4f colorAf(om::FaceHandle) const override { return om::Vec4f(0.0f); }
  om::Attributes::StatusInfo status(om::FaceHandle) const override { return {}; }
  om::Vec3uc color(om::EdgeHandle) const override { return om::Vec3uc(0); }
  om::Vec4uc colorA(om::EdgeHandle) const override { return om::Vec4uc(0); }
  om::Vec3ui colori(om::EdgeHandle) const override { return om::Vec3ui(0u); }
  om::Vec4ui colorAi(om::EdgeHandle) const override { return om::Vec4ui(0u); }
  om::Vec3f colorf(om::EdgeHandle) const override { return om::Vec3f(0.0f); }
  om::Vec4f colorAf(om::EdgeHandle) const override { return om::Vec4f(0.0f); }
  om::Attributes::StatusInfo status(om::EdgeHandle) const override { return {}; }
  int get_halfedge_id(om::VertexHandle) override { return -1; }
  int get_halfedge_id(om::FaceHandle) override { return -1; }
  int get_next_halfedge_id(om::HalfedgeHandle) override { return -1; }
  int get_to_vertex_id(om::HalfedgeHandle) override { return -1; }
  int get_face_id(om::HalfedgeHandle) override { return -1; }
  om::Attributes::StatusInfo status(om::HalfedgeHandle) const override { return {}; }

 private:
  static om::Vec3f toOpenMesh(const glm::vec3& v) { return {v.x, v.y, v.z}; }
  template <class T>
  static om::VectorT<T, 4> withAlpha(const om::VectorT<T, 3>& c, T alpha) {
    return {c[0], c[1], c[2], alpha};
  }

  std::vector<om::Vec3f> points_, normals_, colors_;
  std::vector<glm::uvec3> triangles_;
  om::TriMesh_ArrayKernelT<> noProperties_;
};

/// The writers log to OpenMesh's global streams; here every outcome is in the return value.
class Silence {
 public:
  Silence() {
    for (const auto& [stream, enabled] : streams_) stream->disable();
  }
  ~Silence() {
    for (const auto& [stream, enabled] : streams_)
      if (enabled) stream->enable();
  }

 private:
  const std::pair<om::mostream*, bool> streams_[3]{
      {&omlog(), omlog().is_enabled()}, {&omout(), omout().is_enabled()}, {&omerr(), omerr().is_enabled()}};
};

}  // namespace

Status encodePlain(std::ostream& out, PlainFormat format, const std::vector<ExportPart>& parts) {
  const Silence silence;
  Soup soup(parts);
  using Options = om::IO::Options;
  constexpr auto kDigits = std::numeric_limits<float>::max_digits10;
  bool written = false;
  switch (format) {
    case PlainFormat::Stl:
      written = om::IO::STLWriter().write(out, soup, Options(Options::Binary), kDigits);
      break;
    case PlainFormat::Ply: {
      const Options options(Options::Binary | Options::LSB | Options::VertexNormal | Options::VertexColor);
      written = om::IO::PLYWriter().write(out, soup, options, kDigits);
      break;
    }
    case PlainFormat::Obj:
      written = om::IO::OBJWriter().write(out, soup, Options(Options::VertexNormal), kDigits);
      break;
  }
  if (!written) return Error{ErrorKind::Files, "OpenMesh could not encode the mesh; write .glb instead"};
  return okStatus();
}

}  // namespace sdf
