#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <tbb/task_arena.h>
#include <tiny_gltf.h>

#include "fuzz/bytes.h"
#include "fuzz/shapes.h"
#include "fuzz/targets.h"
#include "sdf/export/plain.h"
#include "sdf/gltf/gltf.h"
#include "sdf/mesh/mesher.h"

namespace sdf::fuzz {
namespace {

constexpr int kMostEntries = 8;
constexpr std::int64_t kMostNodes = 4000;  // some operators repeat what they are given
constexpr int kMostVoxels = 20;            // along the longest side

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// The topology of an indexed mesh, worked out as plainly as can be.
struct Topology {
  bool watertight = true;
  int components = 0;
  std::ptrdiff_t eulerCharacteristic = 0;
};

std::uint32_t rootOf(const std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v];
  return v;
}

Topology topologyOf(const Mesh& mesh) {
  const auto welded = [&](std::uint32_t v) { return v < mesh.welded ? v : mesh.copyOf[v - mesh.welded]; };
  std::map<Edge, int> edges;  // times run upwards less times run downwards
  std::vector<std::uint32_t> parent(mesh.welded);
  std::iota(parent.begin(), parent.end(), 0u);
  std::vector<bool> used(mesh.welded, false);
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = welded(t[k]), b = welded(t[(k + 1) % 3]);
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
      parent[rootOf(parent, a)] = rootOf(parent, b);
      used[a] = true;
    }
  Topology result;
  for (const auto& [edge, balance] : edges) result.watertight = result.watertight && balance == 0;
  const auto vertices = std::count(used.begin(), used.end(), true);
  for (std::uint32_t v = 0; v < mesh.welded; ++v) result.components += used[v] && parent[v] == v;
  result.eulerCharacteristic = vertices - static_cast<std::ptrdiff_t>(edges.size()) +
                               static_cast<std::ptrdiff_t>(mesh.triangles.size());
  return result;
}

void checkVertices(const Mesh& mesh, const Box& within) {
  if (mesh.normals.size() != mesh.positions.size() || mesh.colors.size() != mesh.positions.size() ||
      mesh.welded + mesh.copyOf.size() != mesh.positions.size())
    find("vertex arrays of different lengths");
  constexpr float kUnit = 1e-6f;  // a few roundings of a float near 1
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const std::string name = "vertex " + std::to_string(i);
    const glm::dvec3 p(mesh.positions[i]);
    if (!finite(mesh.positions[i])) find(name + " has no finite position");
    if (!within.contains({p, p})) find(name + " lies outside the bounds grown by a voxel");
    if (!(std::abs(glm::length(mesh.normals[i]) - 1.0f) <= kUnit))
      find(name + " has a normal that is not unit");
    const glm::vec3& c = mesh.colors[i];
    if (!(c.x >= 0.0f && c.x <= 1.0f && c.y >= 0.0f && c.y <= 1.0f && c.z >= 0.0f && c.z <= 1.0f))
      find(name + " has a colour outside [0, 1]");
  }
  for (const std::uint32_t v : mesh.copyOf)
    if (v >= mesh.welded) find("a copy of no vertex");
}

void checkTriangles(const Mesh& mesh, const MeshStats& stats) {
  if (mesh.triangleMaterial.size() != mesh.triangles.size()) find("triangles without a material");
  for (const glm::uvec3& t : mesh.triangles)
    if (std::max({t.x, t.y, t.z}) >= mesh.positions.size()) find("an index out of range");
  for (const std::uint32_t m : mesh.triangleMaterial)
    if (m >= mesh.materials.size()) find("a material out of range");
  if (!std::is_sorted(mesh.triangleMaterial.begin(), mesh.triangleMaterial.end()))
    find("triangles not in the order of their materials");
  const Topology measured = topologyOf(mesh);
  if (!measured.watertight) find("a mesh that is not watertight");
  if (measured.watertight != stats.watertight) find("the report is wrong about being watertight");
  if (measured.components != stats.components)
    find("the report says " + std::to_string(stats.components) + " components, there are " +
         std::to_string(measured.components));
  if (measured.eulerCharacteristic != stats.eulerCharacteristic)
    find("the report has another Euler characteristic");
  if (!std::isfinite(stats.rmsDistance) || !std::isfinite(stats.maxDistance) ||
      stats.rmsDistance > stats.maxDistance)
    find("measured distances that cannot be: rms " + std::to_string(stats.rmsDistance) + ", largest " +
         std::to_string(stats.maxDistance));
}

// --- the files ---

template <class Encode>
std::string encoded(const Encode& encode) {
  std::ostringstream out;
  const Status status = encode(out);
  if (!status) find("not encoded: " + status.error().message);
  return std::move(out).str();
}

void checkModel(const tinygltf::Model& model, const Mesh& mesh) {
  std::size_t triangles = 0;
  for (const tinygltf::Mesh& m : model.meshes)
    for (const tinygltf::Primitive& p : m.primitives) {
      const auto& indices = model.accessors.at(p.indices);
      const auto& positions = model.accessors.at(p.attributes.at("POSITION"));
      triangles += indices.count / 3;
      if (positions.minValues.size() != 3 || positions.maxValues.size() != 3)
        find("positions without bounds");
    }
  if (triangles != mesh.triangles.size())
    find(std::to_string(triangles) + " triangles in the file, " + std::to_string(mesh.triangles.size()) +
         " in the mesh");
}

void checkGltf(const Scene& scene, const std::vector<ExportPart>& parts) {
  tinygltf::TinyGLTF loader;
  for (const auto container : {GltfContainer::Binary, GltfContainer::Text}) {
    const std::string bytes =
        encoded([&](std::ostream& out) { return encodeGltf(out, container, scene, parts); });
    tinygltf::Model model;
    std::string errors, warnings;
    const auto size = static_cast<unsigned>(bytes.size());
    const bool read =
        container == GltfContainer::Binary
            ? loader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                          reinterpret_cast<const unsigned char*>(bytes.data()), size)
            : loader.LoadASCIIFromString(&model, &errors, &warnings, bytes.data(), size, "");
    if (!read || !errors.empty()) find("tinygltf does not read the file back: " + errors);
    checkModel(model, parts[0].mesh);
  }
}

std::size_t linesThatStart(const std::string& text, const std::string& start) {
  std::size_t count = text.starts_with(start);
  for (std::size_t at = text.find("\n" + start); at != std::string::npos;
       at = text.find("\n" + start, at + 1))
    ++count;
  return count;
}

void checkPlain(const std::vector<ExportPart>& parts) {
  const Mesh& mesh = parts[0].mesh;
  const auto write = [&](PlainFormat format) {
    return encoded([&](std::ostream& out) { return encodePlain(out, format, parts); });
  };
  constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;
  if (write(PlainFormat::Stl).size() != kStlHeader + kStlTriangle * mesh.triangles.size())
    find("an .stl of another size");
  const std::string ply = write(PlainFormat::Ply);
  if (ply.find("element vertex " + std::to_string(mesh.welded) + "\n") == std::string::npos ||
      ply.find("element face " + std::to_string(mesh.triangles.size()) + "\n") == std::string::npos)
    find("a .ply of other counts");
  const std::string obj = write(PlainFormat::Obj);
  if (linesThatStart(obj, "v ") != mesh.welded || linesThatStart(obj, "f ") != mesh.triangles.size())
    find("an .obj of other counts");
}

std::string glbOf(const MeshedShape& meshed) {
  return encoded([&](std::ostream& out) {
    return encodeGltf(out, GltfContainer::Binary, {}, {{"part", meshed.mesh, meshed.stats}});
  });
}

// --- an input ---

// Nothing false is stated of catalog entries, so where floats hold their numbers, a mesh that is refused for
// leaving its bounds or being open is the mesher's fault.
void checkError(const Error& error, bool moderate) {
  if (error.kind != ErrorKind::Scene || !error.message.starts_with("part 'part': ") ||
      error.message.find('\n') != std::string::npos)
    find("an error that does not say which part: '" + error.message + "'");
  for (const char* fault : {"is torn open", "leaves the bounds"})
    if (moderate && error.message.find(fault) != std::string::npos) find(error.message);
}

Box clipOf(Bytes& bytes) {
  const double half = 1 << bytes.below(3);
  const glm::dvec3 centre(bytes.below(2) * 0.375, 0.0, bytes.below(2) * -0.25);
  return {centre - half, centre + half};
}

Result<MeshedShape> mesh(const Shape& shape, const MeshOptions& options) {
  Progress progress;
  return meshShape(shape, "part", options, progress);
}

// On one thread: while the machine is busy, several would mostly wait for one another.
Result<MeshedShape> meshOnOneThread(const Shape& shape, const MeshOptions& options) {
  tbb::task_arena one(1);
  return one.execute([&] { return mesh(shape, options); });
}

void checkMesh(const FuzzedShape& fuzzed, const MeshOptions& options, bool again) {
  const Shape& shape = fuzzed.shape;
  const Result<MeshedShape> result = meshOnOneThread(shape, options);
  if (!result) return checkError(result.error(), fuzzed.moderate);
  checkTriangles(result->mesh, result->stats);
  checkVertices(result->mesh, options.bounds->grown(options.voxelSize));
  const std::vector<ExportPart> parts{{"part", result->mesh, result->stats}};
  checkGltf({}, parts);
  checkPlain(parts);
  if (again && glbOf(*mesh(shape, options)) != glbOf(*result)) find("several threads give other bytes");
}

}  // namespace

void meshed(Input input) {
  Bytes bytes(input);
  try {
    const NodeLimit limit(kMostNodes);
    MeshOptions options;
    options.bounds = clipOf(bytes);
    options.voxelSize = options.bounds->longestSide() / (6 + bytes.below(kMostVoxels - 5));
    const bool again = bytes.below(8) == 0;
    const FuzzedShape fuzzed = readShape(bytes, kMostEntries);
    if (fuzzed.shape.ok()) checkMesh(fuzzed, options, again);
  } catch (const NodeLimitReached&) {
    // Larger than is worth the time.
  }
}

}  // namespace sdf::fuzz
