#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <random>
#include <string>

#include "../bench/shapes.h"
#include "sdf/mesh/mesher.h"
#include "sdf/script/script.h"
#include "sdf/shape/operators/place.h"
#include "support/mesh_audit.h"
#include "support/thorough.h"

namespace sdf::test {
namespace mesh_audit_test {

/// What is meshed: a measuring shape, or the parts of a sample.
struct Subject {
  std::string name;
  double resolution;  ///< voxels along the longest side
};

void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.name; }

bool isMeasuringShape(const Subject& subject) { return subject.name.size() == 2 && subject.name[0] == 'S'; }

std::vector<Part> partsOf(const Subject& subject) {
  if (isMeasuringShape(subject)) return {{subject.name, bench::measuringShape(subject.name[1] - '1')}};
  const Result<Scene> scene = loadScene(SDF_SOURCE_DIR "/samples/" + subject.name + ".lua", {.fixed = true});
  EXPECT_TRUE(scene.ok()) << scene.error().message;
  std::vector<Part> parts = scene->parts;
  for (Part& part : parts)
    if (scene->bounds) part.shape = clipped(part.shape, *scene->bounds);
  return parts;
}

/// Any rotation, a shift by up to a voxel, and up to 1.4 times the size; the first is the shape as it is.
Shape variant(const Shape& shape, int number, double voxel) {
  if (number == 0) return shape;
  std::mt19937 random(static_cast<unsigned>(number));
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi), share(0.0, 1.0);
  const auto three = [&](auto& of) {
    const double x = of(random), y = of(random), z = of(random);
    return Vec3E(x, y, z);
  };
  const Shape turned = rotate(scale(shape, 1.0 + 0.4 * share(random)), three(angle));
  return translate(turned, three(share) * voxel);
}

int variants() { return isThorough() ? 10 : 1; }

class MeshAuditTest : public testing::TestWithParam<Subject> {};

// What is thinner than a voxel may be seen in one position and not in another: how the mesh hangs together,
// and what it stands over, is held to the shape where nothing was missed.
TEST_P(MeshAuditTest, MeshesAreSoundHoweverTheyLie) {
  const std::vector<Part> parts = partsOf(GetParam());
  Box all;
  for (const Part& part : parts) all = unite(all, findBounds(part.shape));
  const double voxel = all.longestSide() / GetParam().resolution;
  for (const Part& part : parts) {
    std::optional<int> components;  // where the part is resolved
    for (int number = 0; number <= variants(); ++number) {
      SCOPED_TRACE(part.name + ", variant " + std::to_string(number));
      const Shape shape = variant(part.shape, number, voxel);
      Progress progress;
      const Result<MeshedShape> meshed = meshShape(shape, part.name, {.voxelSize = voxel}, progress);
      ASSERT_TRUE(meshed.ok()) << meshed.error().message;
      const MeshAudit a = audit(meshed->mesh, shape, 0.01 * voxel);
      EXPECT_TRUE(a.closed);
      EXPECT_TRUE(a.manifold);
      EXPECT_EQ(a.crossings, 0u);
      EXPECT_EQ(meshed->stats.crossings, a.crossings);
      EXPECT_EQ(meshed->stats.components, a.components);
      EXPECT_EQ(meshed->stats.eulerCharacteristic, a.eulerCharacteristic);
      if (meshed->stats.unresolved > 0) continue;
      if (isMeasuringShape(GetParam())) {
        EXPECT_EQ(a.turned, 0u);
      }
      EXPECT_EQ(a.components, components.value_or(a.components));
      components = a.components;
    }
  }
}

std::string nameOf(const testing::TestParamInfo<Subject>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Shapes, MeshAuditTest,
                         testing::Values(Subject{"S1", 60}, Subject{"S2", 60}, Subject{"S3", 60},
                                         Subject{"S4", 70}, Subject{"S5", 70}, Subject{"S6", 160},
                                         Subject{"S7", 160}),
                         nameOf);

INSTANTIATE_TEST_SUITE_P(Samples, MeshAuditTest,
                         testing::Values(Subject{"chain", 80}, Subject{"chess", 50}, Subject{"creature", 60},
                                         Subject{"dice", 60}, Subject{"gear", 60}, Subject{"gyroid_ball", 60},
                                         Subject{"lattice", 60}, Subject{"lighting_stack", 60},
                                         Subject{"machined_part", 60}, Subject{"melting_landscape", 60},
                                         Subject{"metaballs", 60}, Subject{"metals", 60}, Subject{"mug", 90},
                                         Subject{"pawn", 60}, Subject{"phong_spheres", 60},
                                         Subject{"planet", 60}, Subject{"step_ao", 60},
                                         Subject{"sunflower", 30}, Subject{"twisted_tower", 60}),
                         nameOf);

}  // namespace mesh_audit_test
}  // namespace sdf::test
