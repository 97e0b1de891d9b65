#include "sdf/mesh/dress/color.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <unordered_map>

#include "sdf/eval/regional_reading.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/surface_paint.h"

namespace sdf {
namespace {

// How far a vertex on a border looks into a triangle for its paint, as a share of the way to the centroid,
// where the material is known: no farther than it must.
constexpr float kBorderShifts[] = {0.05f, 0.15f, 0.3f, 0.6f, 1.0f};
constexpr std::size_t kMaterialSamples = 64;

float unit(float v) { return std::isfinite(v) ? std::clamp(v, 0.0f, 1.0f) : 0.0f; }

glm::vec3 centroid(const Mesh& mesh, const glm::uvec3& t) {
  return (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
}

void orderByMaterial(Mesh& mesh) {
  std::vector<std::uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return mesh.triangleMaterial[t]; });
  std::ranges::sort(mesh.triangleMaterial);
  const std::vector<glm::uvec3> triangles = std::move(mesh.triangles);
  mesh.triangles.clear();
  for (const std::uint32_t t : order) mesh.triangles.push_back(triangles[t]);
}

// The shape's materials that occur, and each triangle's place among them.
void assignMaterials(const Shape& shape, const std::vector<int>& ids, Mesh& mesh) {
  std::map<int, std::uint32_t> placeOf;
  for (const int id : ids) placeOf.emplace(id, 0);
  for (int id = 0; id < static_cast<int>(shape.materials.size()); ++id)
    if (const auto it = placeOf.find(id); it != placeOf.end()) {
      const std::string& name = shape.materials[id]->name;
      it->second = static_cast<std::uint32_t>(mesh.materials.size());
      mesh.materials.push_back(
          {.name = name.empty() ? "material " + std::to_string(id + 1) : name, .number = id});
    }
  mesh.triangleMaterial.resize(ids.size());
  for (std::size_t t = 0; t < ids.size(); ++t) mesh.triangleMaterial[t] = placeOf[ids[t]];
  if (mesh.materials.size() > 1) orderByMaterial(mesh);
}

// Returns the copy, which has no colour yet.
std::uint32_t repeatVertex(Mesh& mesh, std::uint32_t v) {
  mesh.positions.push_back(glm::vec3(mesh.positions[v]));
  mesh.normals.push_back(glm::vec3(mesh.normals[v]));
  mesh.colors.emplace_back();
  mesh.ambient.emplace_back();
  mesh.copyOf.push_back(mesh.pointOf(v));
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

// Of the paint on the way from a vertex into its triangle, the first beyond a jump, if there is one: a step
// that is more than what changes otherwise.
std::size_t beyondJump(const Paint* paint, std::size_t count) {
  std::size_t largest = 0;
  float sum = 0.0f, jump = 0.0f;
  for (std::size_t k = 1; k < count; ++k) {
    const float step = colorDifference(paint[k - 1], paint[k]);
    sum += step;
    if (step > jump) jump = step, largest = k;
  }
  return jump > kColorJump && jump > 2.0f * (sum - jump) ? largest : 0;
}

// Gives vertices the colours of their triangles' corners, and repeats those whose triangles do not agree.
void takeCornerColors(const std::vector<std::array<CornerColor, 3>>& colors, Mesh& mesh) {
  const std::size_t given = mesh.positions.size();
  mesh.colors.resize(given), mesh.ambient.resize(given);
  std::vector<char> taken(given, 0);
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> copies;
  const auto shows = [&](std::uint32_t v, const CornerColor& c) {
    return mesh.colors[v] == c.color && mesh.ambient[v] == c.ambient;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& v = mesh.triangles[t][k];
      const CornerColor& own = colors[t][k];
      if (taken[v] && shows(v, own)) continue;
      if (!taken[v]) {
        taken[v] = 1, mesh.colors[v] = own.color, mesh.ambient[v] = own.ambient;
        continue;
      }
      std::vector<std::uint32_t>& others = copies[v];
      const auto same = std::ranges::find_if(others, [&](std::uint32_t u) { return shows(u, own); });
      if (same == others.end()) {
        others.push_back(repeatVertex(mesh, v));
        mesh.colors.back() = own.color, mesh.ambient.back() = own.ambient;
        v = others.back();
      } else {
        v = *same;
      }
    }
}

// Colours the corners of triangles at borders, each on its own side, and repeats vertices whose triangles
// do not agree. Vertices have the paint of their places.
class BorderPainter {
 public:
  BorderPainter(const LocalField& field, Progress& progress, Mesh& mesh)
      : field_(field), progress_(progress), mesh_(mesh) {}

  void run() {
    findVertices();
    findCorners();
    readCorners();
    if (progress_.stopped()) return;
    taken_.assign(mesh_.positions.size(), 0);
    for (const Corner& c : corners_)
      if (c.seen) assign(c);
    for (const Corner& c : corners_)
      if (!c.seen) assignUnseen(c);
  }

 private:
  struct Corner {
    std::uint32_t triangle;
    int corner;
    float size;  // the triangle's
    Paint paint{};
    bool seen = false;  // is its own material seen there?
  };
  // A vertex as some of its triangles have it.
  struct Copy {
    std::uint32_t vertex;
    Paint paint;
  };

  Paint paintOf(std::uint32_t v, int material) const { return {mesh_.colors[v], mesh_.ambient[v], material}; }
  int materialOf(std::size_t t) const { return mesh_.materials[mesh_.triangleMaterial[t]].number; }

  // Those on creases, which may be borders, and those that look otherwise than a triangle's middle.
  void findVertices() {
    atBorder_.assign(mesh_.positions.size(), 0);
    for (std::size_t i = 0; i < mesh_.copyOf.size(); ++i)
      atBorder_[mesh_.welded + i] = atBorder_[mesh_.copyOf[i]] = kOnCrease;
    std::vector<glm::vec3> middles;
    for (const glm::uvec3& t : mesh_.triangles) middles.push_back(centroid(mesh_, t));
    const std::vector<Paint> paint = readPaintBeside(middles, field_, progress_);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh_.triangles[t][k];
        if (!atBorder_[v] && colorDifference(paintOf(v, 0), paint[t]) > kColorJump) atBorder_[v] = kBeside;
      }
  }

  // Large triangles first: they know best.
  void findCorners() {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const glm::uvec3& v = mesh_.triangles[t];
      const glm::vec3 a = mesh_.positions[v.x];
      const float size = glm::length(glm::cross(mesh_.positions[v.y] - a, mesh_.positions[v.z] - a));
      for (int k = 0; k < 3; ++k)
        if (atBorder_[v[k]]) corners_.push_back({t, k, size});
    }
    std::ranges::stable_sort(corners_, std::greater{}, &Corner::size);
  }

  void readCorners() {
    constexpr std::size_t kShifts = std::size(kBorderShifts);
    std::vector<glm::vec3> places;
    for (const Corner& c : corners_) {
      const glm::uvec3& t = mesh_.triangles[c.triangle];
      for (const float shift : kBorderShifts)
        places.push_back(glm::mix(mesh_.positions[t[c.corner]], centroid(mesh_, t), shift));
    }
    const std::vector<Paint> all = readPaintBeside(places, field_, progress_);
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      Corner& c = corners_[i];
      const Paint* paint = &all[kShifts * i];
      const std::uint32_t v = mesh_.triangles[c.triangle][c.corner];
      const int own = materialOf(c.triangle);
      std::size_t k = beyondJump(paint, kShifts);
      while (k + 1 < kShifts && paint[k].material != own) ++k;
      c.seen = paint[k].material == own;
      const bool asItIs =
          atBorder_[v] == kBeside && k == 0 && colorDifference(paintOf(v, own), paint[0]) <= kColorJump;
      c.paint = asItIs ? paintOf(v, own) : paint[k];
    }
  }

  void assign(const Corner& c) {
    std::uint32_t& v = mesh_.triangles[c.triangle][c.corner];
    std::vector<Copy>& copies = copies_[v];
    for (const Copy& copy : copies)
      if (!differ(copy.paint, c.paint)) {
        v = copy.vertex;
        return;
      }
    std::uint32_t own = v;
    if (taken_[v]) {
      own = repeatVertex(mesh_, v);
    } else {
      taken_[v] = 1;
    }
    mesh_.colors[own] = c.paint.color, mesh_.ambient[own] = c.paint.ambient;
    copies.push_back({own, c.paint});
    v = own;
  }

  // Slivers along a border, off by rounding, are as their material is at the vertex, or as their other
  // corners.
  void assignUnseen(Corner c) {
    const glm::uvec3& t = mesh_.triangles[c.triangle];
    c.paint.material = materialOf(c.triangle);
    const auto& copies = copies_[t[c.corner]];
    const auto same =
        std::ranges::find(copies, c.paint.material, [](const Copy& k) { return k.paint.material; });
    if (same != copies.end())
      c.paint = same->paint;
    else
      for (const int k : {1, 2})
        if (const std::uint32_t v = t[(c.corner + k) % 3]; v >= taken_.size() || taken_[v] || !atBorder_[v])
          c.paint = paintOf(v, c.paint.material);
    assign(c);
  }

  static constexpr char kOnCrease = 1, kBeside = 2;

  const LocalField& field_;
  Progress& progress_;
  Mesh& mesh_;
  std::vector<char> atBorder_;  // by vertex
  std::vector<Corner> corners_;
  std::vector<char> taken_;                                      // by vertex: some triangle's already
  std::unordered_map<std::uint32_t, std::vector<Copy>> copies_;  // by vertex
};

// Reads what each vertex shows, on its own side of a border.
void readColors(bool hasBorders, const LocalField& field, Progress& progress, Mesh& mesh) {
  const std::vector<Paint> paint = readPaint(
      mesh.positions.size(), [&](std::size_t i) { return mesh.positions[i]; },
      [&](std::size_t i) { return mesh.normals[i]; }, field, progress);
  for (const Paint& p : paint) mesh.colors.push_back(p.color), mesh.ambient.push_back(p.ambient);
  if (hasBorders) BorderPainter(field, progress, mesh).run();
}

// Some of the triangles of each material, evenly spread, by material.
std::vector<std::vector<std::size_t>> sampledTriangles(const Mesh& mesh) {
  std::vector<std::vector<std::size_t>> sampled;
  for (std::uint32_t m = 0; m < mesh.materials.size(); ++m) {
    const auto begin = mesh.triangleMaterial.begin();
    const auto [from, to] = std::equal_range(begin, mesh.triangleMaterial.end(), m);
    const std::size_t stride = std::max<std::size_t>(1, (to - from) / kMaterialSamples);
    std::vector<std::size_t>& own = sampled.emplace_back();
    for (std::size_t t = from - begin; t < static_cast<std::size_t>(to - begin); t += stride)
      own.push_back(t);
  }
  return sampled;
}

// The attributes in the middles of these triangles, all of one triangle after another.
std::vector<double> readAttributes(const Shape& shape, const Values& values, const Mesh& mesh,
                                   const std::vector<std::vector<std::size_t>>& triangles) {
  std::vector<glm::dvec3> points, normals;
  for (const auto& some : triangles)
    for (const std::size_t t : some) {
      points.emplace_back(centroid(mesh, mesh.triangles[t]));
      normals.emplace_back(mesh.normals[mesh.triangles[t].x]);
    }
  return evaluateEach(Function({shape.surface.begin(), shape.surface.end()}).at(values), points, normals);
}

// Averages of the attributes that a glTF material holds as single numbers, over some of the material's
// triangles.
void resolveMaterials(const Shape& shape, const Values& values, Mesh& mesh) {
  const std::vector<std::vector<std::size_t>> triangles = sampledTriangles(mesh);
  const std::vector<double> attributes = readAttributes(shape, values, mesh, triangles);
  const double* v = attributes.data();
  for (std::uint32_t m = 0; m < mesh.materials.size(); ++m) {
    std::array<double, kAttributeCount> sum{};
    for (std::size_t i = 0; i < triangles[m].size(); ++i, v += kAttributeCount)
      for (int a = 0; a < kAttributeCount; ++a) sum[a] += std::isfinite(v[a]) ? v[a] : 0.0;
    auto mean = [&](Attribute a) {
      const double samples = std::max(static_cast<double>(triangles[m].size()), 1.0);
      return static_cast<float>(sum[static_cast<int>(a)] / samples);
    };
    MeshMaterial& out = mesh.materials[m];
    out.color = {unit(mean(Attribute::Red)), unit(mean(Attribute::Green)), unit(mean(Attribute::Blue))};
    out.specular = {mean(Attribute::SpecularRed), mean(Attribute::SpecularGreen),
                    mean(Attribute::SpecularBlue)};
    out.shininess = mean(Attribute::Shininess);
    out.reflectivity = mean(Attribute::Reflectivity);
    out.fresnelPower = mean(Attribute::FresnelPower);
    out.fresnelBias = mean(Attribute::FresnelBias);
    out.emission = {mean(Attribute::EmissionRed), mean(Attribute::EmissionGreen),
                    mean(Attribute::EmissionBlue)};
  }
}

}  // namespace

void colorMesh(const Shape& shape, const FeatureMesh& features, const Values& values, const LocalField& field,
               Progress& progress, Mesh& mesh) {
  const std::vector<int>& materials = features.materials;
  if (!features.colors.empty()) takeCornerColors(features.colors, mesh);
  const Expr& id = shape.surface[static_cast<int>(Attribute::MaterialId)];
  const int only = id.isConstant() ? static_cast<int>(id.constantValue()) : 0;
  assignMaterials(shape, materials.empty() ? std::vector<int>(mesh.triangles.size(), only) : materials, mesh);
  if (features.colors.empty()) readColors(!materials.empty(), field, progress, mesh);
  resolveMaterials(shape, values, mesh);
}

void takeMaterials(const Shape& shape, const std::vector<int>& numbers, const Values& values, Mesh& mesh) {
  assignMaterials(shape, numbers, mesh);
  resolveMaterials(shape, values, mesh);
}

}  // namespace sdf
