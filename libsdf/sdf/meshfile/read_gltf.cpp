// The triangles of a glTF file's scene.
#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "sdf/meshfile/gltf_document-inl.h"
#include "sdf/meshfile/gltf_look-inl.h"
#include "sdf/meshfile/read_formats.h"

namespace sdf {
namespace {

glm::dvec3 vectorOf(const std::vector<double>& numbers, double otherwise) {
  return numbers.size() < 3 ? glm::dvec3(otherwise) : glm::dvec3(numbers[0], numbers[1], numbers[2]);
}

/// 3.5.2: scaled first, then turned, then moved.
glm::dmat4 placementOf(const tinygltf::Node& node) {
  glm::dmat4 out(1.0);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) out[i / 4][i % 4] = node.matrix[i];
    return out;
  }
  glm::dquat turn(1.0, 0.0, 0.0, 0.0);
  if (node.rotation.size() == 4)
    turn = glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
  const glm::dmat3 rotation = glm::mat3_cast(turn);
  const glm::dvec3 scale = vectorOf(node.scale, 1.0);
  for (int k = 0; k < 3; ++k) out[k] = glm::dvec4(rotation[k] * scale[k], 0.0);
  out[3] = glm::dvec4(vectorOf(node.translation, 0.0), 1.0);
  return out;
}

/// Where a mesh stands.
struct Place {
  glm::dmat4 points;
  glm::dmat3 normals;  ///< the inverse's transpose, times |determinant|
  bool mirrored;

  explicit Place(const glm::dmat4& place) : points(place) {
    const glm::dmat3 m(place);
    mirrored = glm::determinant(m) < 0.0;
    normals = glm::dmat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    if (mirrored) normals = -normals;
  }
};

/// The vertices of one primitive, as accessors say them.
struct GltfVertices {
  GltfElements positions;
  std::optional<GltfElements> normals, colors, textureAt;
  std::optional<GltfElements> indices;

  std::size_t corners() const { return indices ? indices->count() : positions.count(); }
  std::uint32_t at(std::size_t corner) const {
    return indices ? indices->index(corner) : static_cast<std::uint32_t>(corner);
  }
};

class GltfReader {
 public:
  explicit GltfReader(GltfDocument document) : document_(std::move(document)), look_(document_, read_) {}

  Result<ReadMesh> read() {
    read_.warnings = document_.warnings();
    hasNormals_ = hasAttribute("NORMAL");
    hasColors_ = hasAttribute("COLOR_0");
    hasTexture_ = !document_.pictures().empty() && hasAttribute("TEXCOORD_");
    struct Placed {
      int node;
      glm::dmat4 place;
    };
    std::vector<Placed> open;
    for (const int root : roots()) open.push_back({root, glm::dmat4(1.0)});
    const auto& nodes = document_.model().nodes;
    std::vector<bool> seen(nodes.size(), false);
    std::ranges::reverse(open);
    while (!open.empty()) {
      const auto [index, above] = open.back();
      open.pop_back();
      if (index < 0 || index >= static_cast<int>(nodes.size()))
        return bad("it has no node " + std::to_string(index));
      if (seen[index]) return bad("its node " + std::to_string(index) + " is in more than one place");
      seen[index] = true;
      const glm::dmat4 place = above * placementOf(nodes[index]);
      if (Status done = addMesh(nodes[index].mesh, Place(place)); !done) return done.error();
      const std::vector<int>& children = nodes[index].children;
      for (auto child = children.rbegin(); child != children.rend(); ++child) open.push_back({*child, place});
    }
    if (read_.mesh.materials.empty()) read_.mesh.materials.emplace_back();
    if (read_.mesh.images.empty()) read_.mesh.textureAt.clear();
    return std::move(read_);
  }

 private:
  Error bad(const std::string& what) const { return unreadable(document_.file().path, what); }

  /// 3.5.1: the nodes of the scene to be shown; without scenes, all that are no other's children.
  std::vector<int> roots() const {
    const tinygltf::Model& model = document_.model();
    const std::size_t scene = std::max(model.defaultScene, 0);
    if (scene < model.scenes.size()) return model.scenes[scene].nodes;
    std::vector<bool> isChild(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes)
      for (const int child : node.children)
        if (child >= 0 && child < static_cast<int>(isChild.size())) isChild[child] = true;
    std::vector<int> out;
    for (std::size_t i = 0; i < isChild.size(); ++i)
      if (!isChild[i]) out.push_back(static_cast<int>(i));
    return out;
  }

  Status addMesh(int index, const Place& place) {
    if (index < 0) return okStatus();
    if (index >= static_cast<int>(document_.model().meshes.size()))
      return bad("it has no mesh " + std::to_string(index));
    shared_ = nullptr;
    for (const tinygltf::Primitive& primitive : document_.model().meshes[index].primitives)
      if (Status done = addPrimitive(primitive, place); !done) return done;
    return okStatus();
  }

  Status addPrimitive(const tinygltf::Primitive& primitive, const Place& place) {
    const int mode = primitive.mode;
    const bool isList = mode == TINYGLTF_MODE_TRIANGLES, isStrip = mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    if (!isList && !isStrip && mode != TINYGLTF_MODE_TRIANGLE_FAN) {
      warn(read_.warnings, "points and lines are left out");
      return okStatus();
    }
    if (primitive.attributes.count("POSITION") == 0) {
      warn(read_.warnings, "primitives without positions are left out");
      return okStatus();
    }
    if (!primitive.targets.empty()) warn(read_.warnings, "its morph targets are left out");
    const Result<GltfLook::Used> look =
        look_.material(primitive.material, primitive.attributes.count("COLOR_0") > 0);
    if (!look) return look.error();
    const Result<GltfVertices> vertices = open(primitive, *look);
    if (!vertices) return vertices.error();

    const std::size_t corners = vertices->corners();
    const std::size_t triangles = isList ? corners / 3 : std::max<std::size_t>(corners, 2) - 2;
    if (triangles > kMostReadTriangles - read_.mesh.triangles.size())
      return tooManyTriangles(document_.file().path);
    startVertices(primitive, *look, *vertices);
    for (std::size_t t = 0; t < triangles; ++t) {
      // 3.7.2.1
      const std::size_t first = isList ? 3 * t : (isStrip ? t : 0);
      const std::size_t turned = isStrip ? t % 2 : 0;
      std::uint32_t of[3] = {vertices->at(first), vertices->at((isList || isStrip ? first : t) + 1 + turned),
                             vertices->at((isList || isStrip ? first : t) + 2 - turned)};
      if (place.mirrored) std::swap(of[1], of[2]);
      for (std::uint32_t& v : of) {
        if (v >= vertices->positions.count()) {
          return bad("a triangle names vertex " + std::to_string(v) + ", and there are " +
                     std::to_string(vertices->positions.count()) + ", numbered from 0");
        }
        v = vertex(v, *vertices, place);
      }
      read_.mesh.triangles.push_back({of[0], of[1], of[2]});
      read_.mesh.materialOf.push_back(look->place);
    }
    return okStatus();
  }

  Result<GltfVertices> open(const tinygltf::Primitive& primitive, const GltfLook::Used& look) {
    GltfVertices out;
    // An attribute of that name, of as many elements as there are positions.
    const auto attribute = [&](const std::string& name, int fewest, int most,
                               std::optional<GltfElements>& to) -> Status {
      const auto found = primitive.attributes.find(name);
      if (found == primitive.attributes.end()) return okStatus();
      Result<GltfElements> elements = GltfElements::open(document_, found->second);
      if (!elements) return elements.error();
      if (elements->components() < fewest || elements->components() > most)
        return bad("its accessor " + std::to_string(found->second) + " is of no type for " + name);
      to = std::move(*elements);
      return okStatus();
    };
    std::optional<GltfElements> positions;
    const int set = look.textureAt ? look.textureAt->set : 0;
    for (const Status& done : {attribute("POSITION", 3, 3, positions), attribute("NORMAL", 3, 3, out.normals),
                               attribute("COLOR_0", 3, 4, out.colors),
                               attribute("TEXCOORD_" + std::to_string(set), 2, 2, out.textureAt)})
      if (!done) return done.error();
    out.positions = std::move(*positions);
    for (const auto* other : {&out.normals, &out.colors, &out.textureAt})
      if (*other && (*other)->count() < out.positions.count())
        return bad("a primitive has fewer normals, colours or texture coordinates than positions");
    if (look.textureAt && !out.textureAt) {
      warn(read_.warnings, "a primitive with a texture has no TEXCOORD_" + std::to_string(set));
    }
    if (primitive.indices < 0) return out;
    Result<GltfElements> indices = GltfElements::open(document_, primitive.indices);
    if (!indices) return indices.error();
    if (!indices->isUnsigned() || indices->components() != 1)
      return bad("its accessor " + std::to_string(primitive.indices) + " is of no type for indices");
    out.indices = std::move(*indices);
    return out;
  }

  // --- vertices, each taken over when a triangle first has it ---

  /// Primitives with the same attributes share vertices, as long as they read them alike.
  void startVertices(const tinygltf::Primitive& primitive, const GltfLook::Used& look,
                     const GltfVertices& from) {
    const GltfTextureAt textureAt = look.textureAt.value_or(GltfTextureAt{});
    const bool isShared = shared_ && shared_->attributes == primitive.attributes && textureAt == textureAt_;
    shared_ = &primitive;
    textureAt_ = textureAt;
    if (isShared) return;
    ++epoch_;
    if (taken_.size() < from.positions.count()) taken_.resize(from.positions.count());
  }

  std::uint32_t vertex(std::uint32_t v, const GltfVertices& from, const Place& place) {
    Taken& taken = taken_[v];
    if (taken.epoch == epoch_) return taken.place;
    TriangleMesh& mesh = read_.mesh;
    taken = {epoch_, static_cast<std::uint32_t>(mesh.positions.size())};
    mesh.positions.emplace_back(place.points * glm::dvec4(glm::dvec3(from.positions.at(v)), 1.0));
    if (hasNormals_)
      mesh.normals.emplace_back(from.normals ? place.normals * glm::dvec3(from.normals->at(v))
                                             : glm::dvec3(0.0));
    if (hasColors_) mesh.colors.emplace_back(from.colors ? glm::vec3(from.colors->at(v)) : glm::vec3(1.0f));
    if (hasTexture_) {
      const glm::vec3 at =
          from.textureAt ? glm::vec3(glm::vec2(from.textureAt->at(v)), 1.0f) : glm::vec3(0.0f);
      mesh.textureAt.emplace_back(textureAt_.transform * at);
    }
    return taken.place;
  }

  /// Does a primitive have an attribute whose name begins so?
  bool hasAttribute(const std::string& start) const {
    for (const tinygltf::Mesh& mesh : document_.model().meshes) {
      for (const tinygltf::Primitive& primitive : mesh.primitives) {
        const auto found = primitive.attributes.lower_bound(start);
        if (found != primitive.attributes.end() && found->first.starts_with(start)) return true;
      }
    }
    return false;
  }

  struct Taken {
    std::uint32_t epoch = 0, place = 0;
  };

  GltfDocument document_;
  ReadMesh read_;
  GltfLook look_;
  const tinygltf::Primitive* shared_ = nullptr;
  GltfTextureAt textureAt_;
  std::vector<Taken> taken_;  // by vertex of the attributes; those of another epoch are not
  std::uint32_t epoch_ = 0;
  bool hasNormals_ = false, hasColors_ = false, hasTexture_ = false;
};

}  // namespace

Result<ReadMesh> readGltf(const MeshFile& file) {
  Result<GltfDocument> document = GltfDocument::open(file);
  if (!document) return document.error();
  return GltfReader(std::move(*document)).read();
}

}  // namespace sdf
