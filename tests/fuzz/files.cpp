#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "fuzz/targets.h"
#include "sdf/base/file.h"
#include "sdf/meshfile/read_formats.h"

namespace sdf::fuzz {
namespace {

constexpr std::size_t kMostBytes = 1 << 14;

// Nothing lies in that folder.
constexpr const char* kFolder = "/no/such/folder/";

void checkError(const std::filesystem::path& file, const Error& error) {
  const auto fault = [&](const char* what) { find(std::string(what) + ": '" + error.message + "'"); };
  if (error.kind != ErrorKind::Files && error.kind != ErrorKind::Limits) fault("an error of another kind");
  if (error.message.find_first_of("\r\n") != std::string::npos) fault("more than one line");
  const std::string start = "cannot read '" + file.string() + "': ";
  if (!error.message.starts_with(start)) fault("an error that does not name the file");
  if (error.message.starts_with(start + "it is broken: ")) fault("a library's exception");
}

void checkMesh(const TriangleMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  if (mesh.triangles.empty() || mesh.materials.empty()) find("a mesh of nothing");
  if (mesh.materialOf.size() != mesh.triangles.size()) find("triangles without a material");
  for (const std::size_t size : {mesh.normals.size(), mesh.colors.size(), mesh.textureAt.size()})
    if (size != 0 && size != count) find("vertex arrays of different lengths");
  for (const glm::uvec3& t : mesh.triangles)
    if (std::max({t.x, t.y, t.z}) >= count) find("an index out of range");
  for (const std::uint32_t m : mesh.materialOf)
    if (m >= mesh.materials.size()) find("a material out of range");
  for (const glm::vec3& p : mesh.positions)
    if (!finite(p)) find("a vertex at no finite place");
  constexpr float kUnit = 1e-6f;  // a few roundings of a float near 1
  for (const glm::vec3& n : mesh.normals)
    if (!(std::abs(glm::length(n) - 1.0f) <= kUnit)) find("a normal that is not unit");
  for (const glm::vec3& c : mesh.colors)
    if (!finite(c) || std::min({c.x, c.y, c.z}) < 0.0f || std::max({c.x, c.y, c.z}) > 1.0f)
      find("a colour outside [0, 1]");
  for (const glm::vec2& at : mesh.textureAt)
    if (!std::isfinite(at.x + at.y)) find("texture coordinates that are not finite");
  const auto images = static_cast<int>(mesh.images.size());
  for (const TriangleMaterial& m : mesh.materials)
    if (std::max(m.colorTexture, m.emissionTexture) >= images || !finite(m.color) || !finite(m.emission))
      find("a material that is not sound");
  for (const TextureImage& i : mesh.images)
    if (i.width <= 0 || i.height <= 0 ||
        i.pixels.size() != 4 * static_cast<std::size_t>(i.width) * static_cast<std::size_t>(i.height))
      find("a picture of another size");
}

}  // namespace

void files(Input input) {
  const std::string bytes(input.begin(), input.end());
  const std::size_t blank = bytes.find(' ');
  if (blank == std::string::npos || blank > 16 || bytes.size() > kMostBytes) return;
  const MeshFile file{kFolder + ("a." + bytes.substr(0, blank)), bytes.substr(blank + 1)};
  if (!checkReadable(file.path) || lowerExtension(file.path).size() <= blank) return;
  const Result<ReadMesh> read = readMesh(file);
  if (!read) return checkError(file.path, read.error());
  checkMesh(read->mesh);
}

}  // namespace sdf::fuzz
