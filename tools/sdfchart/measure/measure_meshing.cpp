// Meshers at their settings: time against the distance between mesh and surface.
#include <unistd.h>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>

#include "deadline.h"
#include "measurements.h"
#include "memory_peak.h"
#include "sdf/export/export.h"
#include "sdf/mesh/band/narrow_band.h"
#include "sdf/mesh/creases/sharpen.h"
#include "sdf/mesh/dress/crease_normals.h"
#include "sdf/mesh/mesh.h"
#include "sdf/mesh/mesher.h"
#include "sdf/mesh/surface/local_field.h"
#include "sdf/mesh/surface/project.h"
#include "sdfchart/peers/peers.h"
#include "sdfchart/truth/mesh_truth.h"

namespace sdf::chart {
namespace {

constexpr double kMostSeconds = 20.0;  // of one mesh

// What all measurements of one scene share, made when the first of them runs.
struct SharedShape {
  Subject subject;
  Extent extent;
  Tape distance{Expr(0.0)};
  std::unique_ptr<MeshTruth> truth{};

  std::size_t points() const { return byExtent(extent, 15000, 3000, 500); }
  const MeshTruth& truthNow() {
    if (!truth) truth = truthOf(subject, points());
    return *truth;
  }
};

// What a mesher made: triangles, and of ours the whole mesh.
struct Made {
  JudgedMesh judged;
  std::optional<MeshedShape> ours{};
};
using Mesher = std::function<Made(SharedShape&)>;

// As it would be written without the mesher's normals.
Mesh plainMesh(const JudgedMesh& judged) {
  Mesh mesh;
  for (const glm::dvec3& p : judged.mesh.points) mesh.positions.emplace_back(p);
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
  mesh.colors.assign(mesh.positions.size(), glm::vec3(0.8f));
  mesh.ambient = mesh.colors;
  for (const glm::ivec3& t : judged.mesh.triangles) mesh.triangles.emplace_back(t);
  mesh.triangleMaterial.assign(mesh.triangles.size(), 0);
  mesh.materials.emplace_back();
  mesh.welded = static_cast<std::uint32_t>(mesh.positions.size());
  return mesh;
}

// Bytes of the mesh as a .glb file.
double fileBytes(const Mesh& mesh) {
  const auto file =
      std::filesystem::temp_directory_path() / ("sdfchart_" + std::to_string(::getpid()) + ".glb");
  take(writeMeshes(file, Scene{}, {ExportPart{"part", mesh, MeshStats{}}}));
  const double bytes = static_cast<double>(std::filesystem::file_size(file));
  std::filesystem::remove(file);
  return bytes;
}

void judge(const Made& made, SharedShape& shared, Row& row) {
  judgeMesh(made.judged, shared.truthNow(), shared.points(), row);
  row.bytes = fileBytes(made.ours ? made.ours->mesh : plainMesh(made.judged));
  if (made.ours && made.ours->stats.provenDistance > 0.0) row.proven = made.ours->stats.provenDistance;
}

Measurement measurement(const std::shared_ptr<SharedShape>& shared, Row row, Mesher mesher) {
  row.kind = "meshing";
  row.scene = shared->subject.name;
  row.items = 1.0;
  return {row, [shared, mesher = std::move(mesher)](Row* judged) {
            std::optional<MemoryPeak> peak;
            if (judged) peak.emplace();
            Made made;
            const double seconds = secondsOf([&] { made = mesher(*shared); });
            if (judged) {
              judged->memory = peak->bytes();
              judge(made, *shared, *judged);
            }
            return seconds;
          }};
}

std::vector<std::array<glm::dvec3, 3>> cornerNormals(const std::vector<glm::vec3>& normals,
                                                     const std::vector<glm::uvec3>& triangles) {
  std::vector<std::array<glm::dvec3, 3>> corners;
  for (const glm::uvec3& t : triangles) corners.push_back({normals[t.x], normals[t.y], normals[t.z]});
  return corners;
}

Made judgedAsOurs(MeshedShape meshed) {
  const Mesh& mesh = meshed.mesh;
  Made made{{accuracy::weldedMesh(mesh), cornerNormals(mesh.normals, mesh.triangles)}, std::nullopt};
  made.ours = std::move(meshed);
  return made;
}

Mesher ours(MeshOptions options) {
  return [options](SharedShape& shared) {
    Deadline deadline(kMostSeconds);
    Result<MeshedShape> meshed = meshShape(shared.subject.shape, shared.subject.name, options, deadline);
    deadline.check();
    return judgedAsOurs(take(std::move(meshed)));
  };
}

accuracy::TriangleMesh inDouble(const std::vector<glm::vec3>& points,
                                const std::vector<glm::uvec3>& triangles) {
  accuracy::TriangleMesh mesh;
  for (const glm::vec3& p : points) mesh.points.emplace_back(p);
  for (const glm::uvec3& t : triangles) mesh.triangles.emplace_back(t);
  return mesh;
}

enum class Stage { Extraction, Projection, Creases };

// The library's own stages up to one of them, at voxels of h.
Mesher stagesTo(Stage last, double h) {
  return [last, h](SharedShape& shared) {
    Deadline progress(kMostSeconds);
    const ModelTapes model = Model(shared.subject.shape).at();
    const LocalTapes whole{model.whole(), model.whole()->firstOutputOnly()};
    constexpr double kMaxMemory = 4.0 * (1ull << 30);
    NarrowBand band = take(sampleNarrowBand(model, {h, shared.subject.bounds, kMaxMemory}, progress));
    const BandField field(band, whole);
    RawSurface raw = band.extract();
    if (last == Stage::Extraction) return Made{{inDouble(raw.points, raw.triangles)}};
    const std::vector<glm::vec3> extracted = raw.points;
    std::vector<glm::vec3> normals;
    refineVertices(raw.points, normals, field, progress);
    if (last == Stage::Projection)
      return Made{{inDouble(raw.points, raw.triangles), cornerNormals(normals, raw.triangles)}};
    const Sharpened sharp =
        sharpen(std::move(raw.points), normals, std::move(raw.triangles), extracted, field, progress);
    Mesh mesh;
    splitAtCreases(sharp.mesh, field, 0.0f, progress, mesh);
    return Made{{accuracy::weldedMesh(mesh), cornerNormals(mesh.normals, mesh.triangles)}};
  };
}

void addVoxels(const std::shared_ptr<SharedShape>& shared, int resolution, std::vector<Measurement>& all) {
  const double h = shared->subject.bounds.longestSide() / resolution;
  const std::string setting = std::to_string(resolution) + " voxels";
  const auto add = [&](const char* method, Mesher mesher) {
    all.push_back(measurement(shared, {.method = method, .setting = setting, .size = h}, std::move(mesher)));
  };
  add("OpenVDB, dense",
      [h](SharedShape& s) { return Made{{meshDenselyByOpenVdb(s.subject, s.distance, h)}}; });
  add("extraction alone", stagesTo(Stage::Extraction, h));
  add("+ projection", stagesTo(Stage::Projection, h));
  add("+ creases", stagesTo(Stage::Creases, h));
  add("uniform", ours({.voxelSize = h}));
  constexpr int kProvable = 64;  // voxels a side; proofs of finer meshes take minutes
  if (resolution <= kProvable && shared->subject.easy)
    add("uniform, proven", ours({.voxelSize = h, .certify = true}));
}

void addTolerance(const std::shared_ptr<SharedShape>& shared, double share, std::vector<Measurement>& all) {
  const double tolerance = share * glm::length(shared->subject.bounds.size());
  const MeshOptions options{.tolerance = tolerance, .strict = false};
  Row row{.setting = formatted("%g %% of the diagonal", 100.0 * share), .size = tolerance};
  const auto add = [&](const char* method, Mesher mesher) {
    row.method = method;
    all.push_back(measurement(shared, row, std::move(mesher)));
    row.isDefault = 0.0;
  };
  row.isDefault = share == kDefaultTolerance;
  add("tolerance", ours(options));
  MeshOptions coarse = options;
  coarse.voxelSize = shared->subject.bounds.longestSide() / 64.0;
  add("tolerance, voxels of 1/64", ours(coarse));
  constexpr double kProvable = 9e-4;  // finer, proofs take minutes
  coarse.certify = true;
  if (share >= kProvable && shared->subject.easy) add("tolerance, voxels of 1/64, proven", ours(coarse));
  add("CGAL make_surface_mesh", [tolerance](SharedShape& s) {
    return Made{{meshImplicitlyByCgal(s.subject, s.distance, tolerance, kMostSeconds)}};
  });
}

}  // namespace

std::vector<Batch> meshingBatches(const std::vector<Subject>& subjects, Extent extent) {
  using Integers = std::vector<int>;
  using Numbers = std::vector<double>;
  const auto resolutions = byExtent<Integers>(extent, {16, 32, 64, 128, 256}, {16, 32, 64}, {16});
  const auto tolerances = byExtent<Numbers>(extent, {4e-3, 2e-3, 1e-3, kDefaultTolerance, 2.5e-4},
                                            {2e-3, kDefaultTolerance}, {kDefaultTolerance});
  std::vector<Batch> batches;
  for (const Subject& subject : subjects) {
    const auto shared = std::make_shared<SharedShape>(subject, extent, Tape(subject.shape.distance));
    const auto add = [&](const std::string& what, double weight, auto fill) {
      batches.push_back({.subject = "meshing " + subject.name + ", " + what,
                         .weight = weight,
                         .runs = byExtent(extent, 5, 3, 1),
                         .budget = byExtent(extent, 10.0, 1.5, 0.0),
                         .make = [shared, fill] {
                           std::vector<Measurement> all;
                           fill(shared, all);
                           return all;
                         }});
    };
    for (const int n : resolutions)
      add(std::to_string(n) + " voxels", 1e-3 * n * n / 8.0 + 1.0,
          [n](const auto& s, auto& all) { addVoxels(s, n, all); });
    for (const double share : tolerances) {
      if (!subject.easy && share != kDefaultTolerance) continue;
      add(formatted("tolerance %g %%", 100.0 * share), 4e-3 / share + 1.0,
          [share](const auto& s, auto& all) { addTolerance(s, share, all); });
    }
  }
  return batches;
}

}  // namespace sdf::chart
