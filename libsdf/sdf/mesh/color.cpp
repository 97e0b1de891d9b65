#include "sdf/mesh/stages.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "sdf/eval/scalar_reading.h"

namespace sdf {
namespace {

// How far a vertex on a border looks into a triangle of its own material for its colour, as a share of the
// way to the centroid, where the material is known: no farther than it must.
constexpr float kBorderShifts[] = {0.05f, 0.3f, 1.0f};
constexpr std::size_t kMaterialSamples = 64;

float unit(float v) { return std::isfinite(v) ? std::clamp(v, 0.0f, 1.0f) : 0.0f; }
float notNegative(float v) { return std::isfinite(v) ? std::max(v, 0.0f) : 0.0f; }

glm::vec3 centroid(const Mesh& mesh, const glm::uvec3& t) {
  return (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
}

// Colours and material at each of `count` points.
struct SurfaceSamples {
  std::vector<glm::vec3> colors, ambient;
  std::vector<int> ids;
};

template <class Point, class Normal>
SurfaceSamples sampleSurface(std::size_t count, const Point& point, const Normal& normal,
                             const LocalField& field, Progress& progress) {
  constexpr int kOutputs = static_cast<int>(SurfaceOutput::Count);
  SurfaceSamples s{std::vector<glm::vec3>(count), std::vector<glm::vec3>(count), std::vector<int>(count)};
  forEachRun(count, point, field, progress, [&](const PointRun& run) {
    PointRows normals;
    float values[kOutputs][kBatchPoints];
    for (std::size_t i = 0; i < run.count; ++i) normals.set(i, normal(run.first + i));
    float* out[kOutputs];
    for (int k = 0; k < kOutputs; ++k) out[k] = values[k];
    const auto at = [&](SurfaceOutput output) { return values[static_cast<int>(output)]; };
    const float *const red = at(SurfaceOutput::Red), *const green = at(SurfaceOutput::Green),
                       *const blue = at(SurfaceOutput::Blue), *const id = at(SurfaceOutput::MaterialId),
                       *const ambientRed = at(SurfaceOutput::AmbientRed),
                       *const ambientGreen = at(SurfaceOutput::AmbientGreen),
                       *const ambientBlue = at(SurfaceOutput::AmbientBlue);
    run.batch.evaluate(*run.tapes.surface, run.points.rows(normals), run.count, out);
    for (std::size_t i = 0; i < run.count; ++i) {
      s.colors[run.first + i] = {unit(red[i]), unit(green[i]), unit(blue[i])};
      s.ambient[run.first + i] = {notNegative(ambientRed[i]), notNegative(ambientGreen[i]),
                                  notNegative(ambientBlue[i])};
      s.ids[run.first + i] = static_cast<int>(std::lround(id[i]));
    }
  });
  return s;
}

// The shape's materials that occur, and each triangle's place among them. Returns their ids by place.
std::vector<int> assignMaterials(const Shape& shape, const std::vector<int>& ids, Mesh& mesh) {
  std::map<int, std::uint32_t> placeOf;
  std::vector<int> idAt;
  for (const int id : ids) placeOf.emplace(id, 0);
  for (int id = 0; id < static_cast<int>(shape.materials.size()); ++id)
    if (const auto it = placeOf.find(id); it != placeOf.end()) {
      const std::string& name = shape.materials[id]->name;
      it->second = static_cast<std::uint32_t>(mesh.materials.size());
      mesh.materials.push_back(
          {name.empty() ? "material " + std::to_string(id + 1) : name, {}, {}, {}, {}, {}});
      idAt.push_back(id);
    }
  mesh.triangleMaterial.resize(ids.size());
  for (std::size_t t = 0; t < ids.size(); ++t) mesh.triangleMaterial[t] = placeOf[ids[t]];
  return idAt;
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

// A vertex where materials meet, as one of them sees it.
struct BorderPoint {
  std::uint32_t vertex;
  std::uint32_t material;
  glm::vec3 inside;  // centroid of one of the material's triangles
};

// Gives each material its own copy of the vertices that it shares with an earlier one. Returns all vertices
// of borders, originals included; those on creases, which may be borders, too.
std::vector<BorderPoint> splitBorders(Mesh& mesh) {
  // Of each vertex the first and the last material; the triangles are ordered by theirs.
  std::vector<std::uint32_t> first(mesh.positions.size(), ~0u), last(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t][k];
      first[v] = std::min(first[v], mesh.triangleMaterial[t]);
      last[v] = mesh.triangleMaterial[t];
    }
  std::vector<char> creased(mesh.positions.size(), 0);
  for (std::size_t i = 0; i < mesh.copyOf.size(); ++i) creased[mesh.welded + i] = creased[mesh.copyOf[i]] = 1;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t>
      pointOf;  // (vertex, material) -> its border point
  std::vector<BorderPoint> points;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::vec3 middle = centroid(mesh, mesh.triangles[t]);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t][k], material = mesh.triangleMaterial[t];
      if (first[v] == last[v] && !creased[v]) continue;
      const auto [it, fresh] = pointOf.try_emplace({v, material}, points.size());
      if (fresh) {
        std::uint32_t place = v;
        if (first[v] != material) {
          place = static_cast<std::uint32_t>(mesh.positions.size());
          mesh.positions.push_back(glm::vec3(mesh.positions[v]));
          mesh.normals.push_back(glm::vec3(mesh.normals[v]));
          mesh.copyOf.push_back(v < mesh.welded ? v : mesh.copyOf[v - mesh.welded]);
        }
        points.push_back({place, material, middle});
      }
      mesh.triangles[t][k] = points[it->second].vertex;
    }
  }
  return points;
}

// Colours the vertices of borders, each where its own material is seen.
void colorBorders(std::vector<BorderPoint> points, const std::vector<int>& idAt, const LocalField& field,
                  Progress& progress, Mesh& mesh) {
  for (const float shift : kBorderShifts) {
    const SurfaceSamples s = sampleSurface(
        points.size(),
        [&](std::size_t i) { return glm::mix(mesh.positions[points[i].vertex], points[i].inside, shift); },
        [&](std::size_t i) { return mesh.normals[points[i].vertex]; }, field, progress);
    std::vector<BorderPoint> elsewhere;
    for (std::size_t i = 0; i < points.size(); ++i) {
      mesh.colors[points[i].vertex] = s.colors[i];
      mesh.ambient[points[i].vertex] = s.ambient[i];
      if (s.ids[i] != idAt[points[i].material]) elsewhere.push_back(points[i]);
    }
    points = std::move(elsewhere);
  }
}

// Averages of the attributes that a glTF material holds as single numbers, over some of the material's
// triangles.
void resolveMaterials(const Shape& shape, const Values& values, Mesh& mesh) {
  const TapePtr tape = Function({shape.surface.begin(), shape.surface.end()}).at(values);
  for (std::uint32_t m = 0; m < mesh.materials.size(); ++m) {
    const auto begin = mesh.triangleMaterial.begin();
    const auto [from, to] = std::equal_range(begin, mesh.triangleMaterial.end(), m);
    const std::size_t stride = std::max<std::size_t>(1, (to - from) / kMaterialSamples);
    std::array<double, kAttributeCount> sum{};
    double samples = 0.0;
    for (std::size_t t = from - begin; t < static_cast<std::size_t>(to - begin); t += stride, ++samples) {
      const glm::uvec3& corners = mesh.triangles[t];
      const std::vector<double> v =
          evaluateAll(*tape, glm::dvec3(centroid(mesh, corners)), glm::dvec3(mesh.normals[corners.x]));
      for (int a = 0; a < kAttributeCount; ++a) sum[a] += std::isfinite(v[a]) ? v[a] : 0.0;
    }
    auto mean = [&](Attribute a) {
      return static_cast<float>(sum[static_cast<int>(a)] / std::max(samples, 1.0));
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

void colorMesh(const Shape& shape, const Values& values, const LocalField& field, Progress& progress,
               Mesh& mesh) {
  auto normalOf = [&](std::size_t i) { return mesh.normals[i]; };
  const Expr& id = shape.surface[static_cast<int>(Attribute::MaterialId)];
  std::vector<int> idAt;
  if (id.isConstant()) {
    idAt = assignMaterials(
        shape, std::vector<int>(mesh.triangles.size(), static_cast<int>(id.constantValue())), mesh);
  } else {
    const auto atCentroids = sampleSurface(
        mesh.triangles.size(), [&](std::size_t t) { return centroid(mesh, mesh.triangles[t]); },
        [&](std::size_t t) { return mesh.normals[mesh.triangles[t].x]; }, field, progress);
    if (progress.stopped()) return;  // not every triangle has a material
    idAt = assignMaterials(shape, atCentroids.ids, mesh);
    orderByMaterial(mesh);
  }
  SurfaceSamples samples = sampleSurface(
      mesh.positions.size(), [&](std::size_t i) { return mesh.positions[i]; }, normalOf, field, progress);
  mesh.colors = std::move(samples.colors);
  mesh.ambient = std::move(samples.ambient);
  if (mesh.materials.size() > 1) {
    std::vector<BorderPoint> border = splitBorders(mesh);
    mesh.colors.resize(mesh.positions.size());
    mesh.ambient.resize(mesh.positions.size());
    colorBorders(std::move(border), idAt, field, progress, mesh);
  }
  resolveMaterials(shape, values, mesh);
}

}  // namespace sdf
