#include "subjects.h"

#include "accuracy/meshes/mesh_cases.h"
#include "sdf/mesh/mesher.h"
#include "sdf/script/script.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::chart {
namespace {

using accuracy::PiecewiseSolid;

Subject subject(std::string name, const Shape& shape, PiecewiseSolid solid) {
  return {std::move(name), shape, findBounds(shape),
          std::make_shared<const PiecewiseSolid>(std::move(solid))};
}

}  // namespace

std::vector<Subject> standardSubjects(bool quick) {
  const glm::dvec3 half(0.8, 1.0, 0.6);
  const auto& cases = accuracy::meshCases();
  const auto ofCase = [&](std::size_t i, const char* name) {
    accuracy::MeshCase c = cases.at(i).make();
    Subject made = subject(name, c.shape, std::move(c.solid));
    made.easy = c.easy;
    return made;
  };
  std::vector<Subject> all{ofCase(0, "ball"), ofCase(1, "drilled box"), ofCase(2, "blended balls")};
  if (quick) return all;
  all.push_back(subject("box", box(Vec3E(half)), accuracy::boxSolid(half)));
  all.push_back(ofCase(3, "gyroid sheet"));
  all.push_back(ofCase(4, "thousand balls"));
  return all;
}

Result<Subject> loadSubject(const std::filesystem::path& file) {
  ScriptOptions options;
  options.fixed = true;
  const Result<Scene> scene = loadScene(file, options);
  if (!scene) return scene.error();
  Shape shape = scene->whole();
  const std::string message = "'" + file.string() + "': ";
  if (!shape.ok()) return Error{ErrorKind::Scene, message + *shape.error};
  Box bounds = findBounds(shape);
  if (scene->bounds) {
    shape = clipped(shape, *scene->bounds);
    bounds = intersect(bounds, *scene->bounds);
  }
  if (!bounds.finite())
    return Error{ErrorKind::Scene,
                 message +
                     "unbounded; give bounds({x0,y0,z0}, {x1,y1,z1}) in the scene, or intersect it "
                     "with a box"};
  if (bounds.empty())
    return Error{ErrorKind::Scene, message + "no surface: nothing of it lies inside its bounds"};
  // Whether there is a surface, the mesher knows best.
  constexpr double kCoarse = 64.0;
  Progress progress;
  const MeshOptions coarse{.voxelSize = bounds.longestSide() / kCoarse};
  if (const Result<MeshedShape> tried = meshShape(shape, file.stem().string(), coarse, progress);
      !tried && tried.error().kind == ErrorKind::Scene)
    return Error{ErrorKind::Scene, message + tried.error().message};
  return Subject{file.stem().string(), shape, bounds};
}

}  // namespace sdf::chart
