// Every solid of the catalog, and every flat shape extruded, marched by every method and by small steps.
#include "march/scenes.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/march/oracle.h"
#include "sdf/shape/operators/deform.h"
#include "shape/cases.h"

namespace sdf {
namespace catalog_test {

constexpr int kRays = 12;
constexpr double kSteps = 1000.0;  // of epsilon, along the region's longest side

// Rays through the region, from beyond it to points in it.
Rays raysThrough(const Box& region, unsigned seed) {
  test::Sampler sampler(region, seed);
  Rays rays;
  const double reach = glm::length(region.size());
  while (rays.size() < kRays) {
    const glm::dvec3 to = sampler.orOnAnAxis(), way = sampler.anywhere() - to;
    if (glm::length(way) == 0.0) continue;
    const glm::dvec3 along = glm::normalize(way);
    rays.add(to - 0.75 * reach * along, along, 0.0, 1.5 * reach);
  }
  return rays;
}

TEST(Catalog, IsMarchedNoLaterThanByTheDenseMarch) {
  const unsigned seed = 1;
  for (const test::ShapeCase& c : test::primitiveCases()) {
    const Shape solid = c.shape.dimension == 3 ? c.shape : extrude(c.shape, 0.3);
    const Box region = test::sampleRegion(solid);
    const Rays rays = raysThrough(region, seed);
    const MarchField field = marchField(solid).value();
    ASSERT_TRUE(field.hasSlope()) << c.name;
    const double size = glm::length(region.size()), slack = test::floatSlack(2.0 * size);
    MarchOptions options;
    options.epsilon = region.longestSide() / kSteps;
    options.maxSteps = 1000000;
    std::vector<std::optional<RootBracket>> roots;
    for (std::size_t i = 0; i < rays.size(); ++i)
      roots.push_back(marchDensely(field, rays, i, options.epsilon));
    for (const MarchMethod method : test::kMethods) {
      options.method = method;
      const Hits hits = test::trace(field, rays, options);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        SCOPED_TRACE(c.name + ", " + test::name(method) + ", seed " + std::to_string(seed) + ", " +
                     test::describe(rays, i));
        EXPECT_TRUE(hits.status[i] == RayStatus::Hit || (!roots[i] && hits.status[i] == RayStatus::Miss));
        if (hits.status[i] != RayStatus::Hit) continue;
        EXPECT_LE(hits.t[i], roots[i] ? roots[i]->after + slack : kInfinity);
        if (hits.t[i] == 0.0) continue;  // began in the solid
        EXPECT_LE(std::abs(evaluateAll(*field.distance, rays.at(i, hits.t[i]))[1]), options.epsilon + slack);
      }
    }
  }
}

}  // namespace catalog_test
}  // namespace sdf
