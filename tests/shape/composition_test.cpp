// Random scenes of several operators deep, each result held to the claim that it derived.
#include <algorithm>

#include "claim_checks.h"
#include "sdf/shape/operators.h"
#include "sdf/shape/solids.h"

namespace sdf {
namespace {

class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : points_(seed) {}

  /// What was built, outermost operator first.
  const std::string& story() const { return story_; }

  Shape make(int depth) { return depth == 0 ? solid() : changed(depth); }

 private:
  double number(double lo, double hi) { return points_.uniform(lo, hi); }
  int choice(int n) { return std::min(n - 1, static_cast<int>(points_.uniform(0.0, n))); }
  Vec3E vector(double lo, double hi) { return Vec3E(number(lo, hi), number(lo, hi), number(lo, hi)); }
  Shape told(const char* name, Shape s) {
    story_ = std::string(name) + " " + story_;
    return s;
  }

  Shape solid() {
    switch (choice(7)) {
      case 0:
        return told("sphere", sphere(number(0.2, 0.8)));
      case 1:
        return told("box", box(vector(0.1, 0.8)));
      case 2:
        return told("torus", torus(number(0.4, 0.7), number(0.1, 0.3)));
      case 3:
        return told("cylinder", cylinder(number(0.1, 0.6), number(0.1, 0.6)));
      case 4:
        return told("ellipsoid_bound", ellipsoidBound(vector(0.3, 0.8)));
      case 5:
        return told("capsule", capsule(vector(-0.6, 0.6), vector(-0.6, 0.6), number(0.1, 0.3)));
      default:
        return told("octahedron", octahedron(number(0.3, 0.9)));
    }
  }

  Blend blend() {
    const double k = number(0.05, 0.5);
    const Blend all[] = {Blend::hard(), Blend::quadratic(k), Blend::cubic(k), Blend::exponential(k),
                         Blend::chamfer(k)};
    return all[choice(5)];
  }

  Shape pair(int depth) {
    const Shape a = make(depth - 1), b = translate(make(choice(depth)), vector(-0.5, 0.5));
    switch (choice(5)) {
      case 0:
        return told("intersection", intersect(a, b, blend()));
      case 1:
        return told("difference", subtract(a, b, blend()));
      case 2:
        return told("xor", exclude(a, b, blend()));
      case 3:
        return told("morph", morph(a, b, number(0.0, 1.0)));
      default:
        return told("union", unite(a, b, blend()));
    }
  }

  Shape repeated(const Shape& s) {
    const glm::dvec3 size = s.bounds.finite() ? s.bounds.size() : glm::dvec3(1.0);
    const glm::dvec3 cell(size.x * number(0.4, 1.5), size.y * number(0.6, 1.5), size.z * number(1.0, 1.5));
    return told("repeat_grid",
                repeatGrid(s, Vec3E(cell), glm::ivec3(1 + choice(4), 1 + choice(3), 1 + choice(2))));
  }

  Shape changed(int depth) {
    const int which = choice(16);
    if (which < 4) return pair(depth);
    const Shape s = make(depth - 1);
    switch (which) {
      case 4:
        return told("round", round(s, number(0.0, 0.3)));
      case 5:
        return told("shell", shell(s, number(0.02, 0.2)));
      case 6:
        return told("elongate", elongate(s, vector(0.0, 0.4)));
      case 7:
        return told("displace", displace(s, number(-0.1, 0.1), number(1.0, 10.0)));
      case 8:
        return told("twist", twist(s, number(-2.0, 2.0)));
      case 9:
        return told("bend", bend(s, number(-1.0, 1.0)));
      case 10:
        return told("taper", taper(s, number(-0.5, 0.5)));
      case 11:
        return told("rotate", rotate(s, vector(-3.0, 3.0)));
      case 12:
        return told("scale", scale(s, vector(0.5, 1.5)));
      case 13:
        return told("mirror", mirror(translate(s, vector(-1.0, 1.0)), vector(-1.0, 1.0)));
      case 14:
        return repeated(s);
      default:
        return told("polar_repeat",
                    polarRepeat(translate(s, Vec3E(number(0.0, 2.0), 0.0, 0.0)), 2 + choice(9)));
    }
  }

  Points points_;
  std::string story_;
};

bool mayRefuse(const std::string& message) {
  for (const char* reason : {"would fold", "ends would pass", "shrinks to nothing", "more than 3 cells"})
    if (message.find(reason) != std::string::npos) return true;
  return false;
}

TEST(Compositions, HoldTheClaimsThatTheyDerive) {
  constexpr int kScenes = 150;
  int refused = 0;
  for (unsigned seed = 1; seed <= kScenes; ++seed) {
    RandomScene random(seed);
    const Shape s = random.make(1 + static_cast<int>(seed % 3));
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + random.story());
    if (!s.ok()) {
      EXPECT_TRUE(mayRefuse(*s.error)) << *s.error;
      ++refused;
      continue;
    }
    EXPECT_LE(s.claim.kind, ClaimKind::Bound);
    EXPECT_LE(s.claim.lipschitz, 1.0 + kRounding);
    ASSERT_TRUE(s.bounds.finite());
    const Box where = s.bounds.grown(0.5 + 0.2 * s.bounds.longestSide());
    expectLipschitz(s, where, seed, 1000);
    expectBounded(s, where, seed, 2000);
    expectBound(s, where, seed, 200);
    if (HasFatalFailure()) return;
  }
  EXPECT_LT(refused, kScenes / 5) << "most random scenes must be possible";
}

}  // namespace
}  // namespace sdf
