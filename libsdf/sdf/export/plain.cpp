// STL, PLY and OBJ through OpenMesh's writers.
#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/IO/exporter/ExporterT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// IOManager takes part in the writers' registration, so it comes before them.
#include <OpenMesh/Core/IO/writer/OBJWriter.hh>
#include <OpenMesh/Core/IO/writer/PLYWriter.hh>
#include <OpenMesh/Core/IO/writer/STLWriter.hh>
#include <limits>

#include "sdf/base/srgb.h"
#include "sdf/export/plain.h"

namespace sdf {
namespace {

namespace om = OpenMesh;

/// Shows OpenMesh's writers the parts as one list of triangles over the vertices of a mesh. The mesh has no
/// faces of its own, as a half-edge mesh drops triangles where more than two meet at an edge.
class Soup : public om::IO::ExporterT<om::TriMesh_ArrayKernelT<>> {
 public:
  explicit Soup(const std::vector<ExportPart>& parts) : ExporterT(vertices_) {
    vertices_.request_vertex_normals();
    vertices_.request_vertex_colors();
    for (const ExportPart& part : parts) {
      const Mesh& mesh = part.mesh;
      const auto first = static_cast<std::uint32_t>(vertices_.n_vertices());
      for (std::uint32_t i = 0; i < mesh.welded; ++i) {
        const glm::vec3 &p = mesh.positions[i], &n = mesh.normals[i], &c = mesh.colors[i];
        const om::VertexHandle v = vertices_.add_vertex({p.x, p.y, p.z});
        vertices_.set_normal(v, {n.x, n.y, n.z});
        vertices_.set_color(v, {srgb(c.x), srgb(c.y), srgb(c.z)});
      }
      for (const glm::uvec3& t : mesh.triangles)
        triangles_.push_back(first + glm::uvec3(mesh.pointOf(t.x), mesh.pointOf(t.y), mesh.pointOf(t.z)));
    }
  }

  size_t n_faces() const override { return triangles_.size(); }
  unsigned int get_vhandles(om::FaceHandle f, std::vector<om::VertexHandle>& corners) const override {
    corners.clear();
    const glm::uvec3& t = triangles_[f.idx()];
    for (int k = 0; k < 3; ++k) corners.emplace_back(static_cast<int>(t[k]));
    return 3;
  }

  bool has_face_normals() const override { return true; }
  using ExporterT::normal, ExporterT::normald;
  om::Vec3f normal(om::FaceHandle f) const override {
    const glm::uvec3& t = triangles_[f.idx()];
    const auto corner = [&](unsigned i) { return om::Vec3d(point(om::VertexHandle(static_cast<int>(i)))); };
    const om::Vec3d n = (corner(t.y) - corner(t.x)) % (corner(t.z) - corner(t.x));
    const double length = n.norm();
    return length > 0.0 ? om::Vec3f(n / length) : om::Vec3f(0.0f);
  }
  om::Vec3d normald(om::FaceHandle f) const override { return om::Vec3d(normal(f)); }

 private:
  om::TriMesh_ArrayKernelT<> vertices_;
  std::vector<glm::uvec3> triangles_;
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
