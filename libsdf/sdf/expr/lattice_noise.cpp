#include "sdf/expr/lattice_noise.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <mutex>
#include <utility>

namespace sdf {

namespace {

// Numbers of cells stay whole numbers of 32 bits.
constexpr double kReach = 0x1p30;
// Gradient noise whose slopes are ways to the middles of a cube's edges, of side 2, is 1.0364 at most.
constexpr double kScale = 0.96;

using Cell = glm::ivec3;

// Mixes the bits of three numbers and a seed: products with odd numbers, then the finalizer "lowbias32"
// (Wellons 2018). As in the shader.
constexpr std::uint32_t kFactors[3] = {0x8da6b343u, 0xd8163841u, 0xcb1ab31fu};
std::uint32_t mixed(std::uint32_t h) {
  h ^= h >> 16, h *= 0x7feb352du;
  h ^= h >> 15, h *= 0x846ca68bu;
  return h ^ h >> 16;
}
std::uint32_t factorOf(int cell, int axis) { return static_cast<std::uint32_t>(cell) * kFactors[axis]; }
std::uint32_t hashOf(const Cell& c, std::uint32_t seed) {
  return mixed(factorOf(c.x, 0) ^ factorOf(c.y, 1) ^ factorOf(c.z, 2) ^ seed);
}

// One of the twelve ways from a cube's centre to the middles of its edges.
glm::dvec3 edgeOf(std::uint32_t hash) {
  const double a = (hash & 1u) != 0u ? -1.0 : 1.0, b = (hash & 2u) != 0u ? -1.0 : 1.0;
  const std::uint32_t axis = (hash >> 2) % 3u;
  return axis == 0u ? glm::dvec3(0.0, a, b) : axis == 1u ? glm::dvec3(a, 0.0, b) : glm::dvec3(a, b, 0.0);
}

struct Place {
  Cell cell;
  glm::dvec3 t;  // within the cell
};
Place placeOf(const glm::dvec3& p) {
  const glm::dvec3 within = glm::clamp(p, -kReach, kReach), cell = glm::floor(within);
  return {Cell(cell), within - cell};
}

template <bool kOfSlopes, bool kWithGradient>
ValueAndGradient betweenNodes(std::uint32_t seed, const Place& at) {
  double w[3][2], dw[3];
  std::uint32_t factors[3][2];
  for (int k = 0; k < 3; ++k) {
    const double t = at.t[k], u = t * t * t * (10.0 + t * (6.0 * t - 15.0));
    w[k][0] = 1.0 - u, w[k][1] = u, dw[k] = 30.0 * t * t * (1.0 - t) * (1.0 - t);
    for (int side = 0; side < 2; ++side) factors[k][side] = factorOf(at.cell[k] + side, k);
  }
  ValueAndGradient sum{0.0, glm::dvec3(0.0)};
  for (int i = 0; i < 8; ++i) {
    const int x = i & 1, y = i >> 1 & 1, z = i >> 2;
    const std::uint32_t hash = mixed(factors[0][x] ^ factors[1][y] ^ factors[2][z] ^ seed);
    const glm::dvec3 slope = kOfSlopes ? edgeOf(hash) : glm::dvec3(0.0);
    const double v = kOfSlopes ? glm::dot(slope, at.t - glm::dvec3(x, y, z)) : hash * 0x1p-31 - 1.0;
    const double yz = w[1][y] * w[2][z], all = w[0][x] * yz;
    sum.value += v * all;
    if constexpr (!kWithGradient) continue;
    const glm::dvec3 towards(x ? dw[0] : -dw[0], y ? dw[1] : -dw[1], z ? dw[2] : -dw[2]);
    sum.gradient += v * towards * glm::dvec3(yz, w[0][x] * w[2][z], w[0][x] * w[1][y]) + all * slope;
  }
  constexpr double kTimes = kOfSlopes ? kScale : 1.0;
  return {kTimes * sum.value, kTimes * sum.gradient};
}

// The two nearest points, as ways from them. None is farther than the root of 3: of the points of the cell
// and of the cell beside it that is nearest both are that near. So they lie at most two cells away.
class TwoNearest {
 public:
  glm::dvec3 first{HUGE_VAL}, second{HUGE_VAL};

  TwoNearest(const Place& at, std::uint32_t seed) : at_(at), seed_(seed) {
    double beyond = HUGE_VAL;  // how far the cells that are two away are at least, squared
    for (int k = 0; k < 3; ++k) {
      for (int o = -kMost; o <= kMost; ++o) {
        const double gap = std::max({o - at.t[k], at.t[k] - o - 1.0, 0.0});
        gaps_[k][o + kMost] = gap * gap;
      }
      beyond = std::min({beyond, gaps_[k][0], gaps_[k][2 * kMost]});
    }
    look({0, 0, 0});
    lookAround(1);
    if (next_ > beyond) lookAround(2);
  }

 private:
  static constexpr int kMost = 2;

  // At the cells that are so many away along some axis.
  void lookAround(int reach) {
    for (int z = -reach; z <= reach; ++z)
      for (int y = -reach; y <= reach; ++y) {
        if (gaps_[2][z + kMost] + gaps_[1][y + kMost] >= next_) continue;
        const int step = std::max(std::abs(y), std::abs(z)) == reach ? 1 : 2 * reach;
        for (int x = -reach; x <= reach; x += step) look({x, y, z});
      }
  }

  void look(const Cell& offset) {
    if (gaps_[0][offset.x + kMost] + gaps_[1][offset.y + kMost] + gaps_[2][offset.z + kMost] >= next_) return;
    const std::uint32_t hash = hashOf(at_.cell + offset, seed_);
    const Cell place(hash & 1023u, hash >> 10 & 1023u, hash >> 20 & 1023u);
    const glm::dvec3 way = at_.t - glm::dvec3(offset) - (glm::dvec3(place) + 0.5) / 1024.0;
    const double square = glm::dot(way, way);
    if (square < least_)
      second = std::exchange(first, way), next_ = std::exchange(least_, square);
    else if (square < next_)
      second = way, next_ = square;
  }

  const Place& at_;
  const std::uint32_t seed_;
  double gaps_[3][2 * kMost + 1];  // to the cells by their offset along each axis, squared
  double least_ = HUGE_VAL, next_ = HUGE_VAL;
};

ValueAndGradient lengthOf(const glm::dvec3& way) {
  const double length = glm::length(way);
  return {length, length > 0.0 ? way / length : glm::dvec3(0.0)};
}

constexpr const char* kHash = R"(uint NAMEHash(ivec3 c) {
  uint h = (uint(c.x) * 0x8da6b343u) ^ (uint(c.y) * 0xd8163841u) ^ (uint(c.z) * 0xcb1ab31fu) ^ SEEDu;
  h ^= h >> 16; h *= 0x7feb352du;
  h ^= h >> 15; h *= 0x846ca68bu;
  return h ^ (h >> 16);
}
)";
constexpr const char* kNodes = R"(vec4 NAMERead(vec3 p) {
  vec3 q = clamp(p, -1073741824.0, 1073741824.0), cell = floor(q), t = q - cell, s = 1.0 - t;
  vec3 u = t * t * t * (10.0 + t * (6.0 * t - 15.0)), du = 30.0 * t * t * s * s;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 8; ++i) {
    ivec3 side = ivec3(i & 1, (i >> 1) & 1, i >> 2);
    vec3 w = mix(1.0 - u, u, vec3(side)), d = (2.0 * vec3(side) - 1.0) * du;
    uint h = NAMEHash(ivec3(cell) + side);
    NODE
  }
  return SCALE * sum;
}
float NAME(vec3 p) { return NAMERead(p).x; }
vec3 NAMESlopes(vec3 p) { return NAMERead(p).yzw; }
)";
constexpr const char* kValue = R"(float v = float(h) * 4.656612873077393e-10 - 1.0;
    sum += v * vec4(w.x * w.y * w.z, d.x * w.y * w.z, w.x * d.y * w.z, w.x * w.y * d.z);)";
constexpr const char* kGradient = R"(float a = (h & 1u) != 0u ? -1.0 : 1.0, b = (h & 2u) != 0u ? -1.0 : 1.0;
    uint axis = (h >> 2) % 3u;
    vec3 g = axis == 0u ? vec3(0.0, a, b) : axis == 1u ? vec3(a, 0.0, b) : vec3(a, b, 0.0);
    sum += dot(g, t - vec3(side)) *
           vec4(w.x * w.y * w.z, d.x * w.y * w.z, w.x * d.y * w.z, w.x * w.y * d.z);
    sum.yzw += w.x * w.y * w.z * g;)";
// Few turns of loops: llvmpipe ends all loops of a shader after 65,535 turns together.
constexpr const char* kCells = R"(struct NAMEPoints { vec3 first, second; float least, next; };
void NAMELook(ivec3 cell, vec3 t, ivec3 c, inout NAMEPoints f) {
  vec3 away = max(max(vec3(c) - t, t - vec3(c) - 1.0), vec3(0.0));
  if (dot(away, away) >= f.next) return;
  uint h = NAMEHash(cell + c);
  vec3 way = t - vec3(c) - (vec3(uvec3(h, h >> 10, h >> 20) & 1023u) + 0.5) / 1024.0;
  float square = dot(way, way);
  if (square < f.least) {
    f.second = f.first; f.next = f.least;
    f.first = way; f.least = square;
  } else if (square < f.next) {
    f.second = way; f.next = square;
  }
}
void NAMENearest(vec3 p, out vec3 first, out vec3 second) {
  vec3 q = clamp(p, -1073741824.0, 1073741824.0), start = floor(q), t = q - start;
  ivec3 cell = ivec3(start);
  NAMEPoints f = NAMEPoints(vec3(0.0), vec3(0.0), 1e9, 1e9);
  for (int z = -1; z <= 1; ++z) {
AROUND  }
  vec3 edge = min(1.0 + t, 2.0 - t);
  float beyond = min(edge.x, min(edge.y, edge.z));
  if (f.next > beyond * beyond)
    for (int z = -2; z <= 2; ++z)
      for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x)
          if (max(abs(x), max(abs(y), abs(z))) == 2) NAMELook(cell, t, ivec3(x, y, z), f);
  first = f.first; second = f.second;
}
float NAME(vec3 p) {
  vec3 a, b;
  NAMENearest(p, a, b);
  return VALUE;
}
vec3 NAMESlopes(vec3 p) {
  vec3 a, b;
  NAMENearest(p, a, b);
  return SLOPES;
}
)";

std::string replaced(std::string text, const std::string& word, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += by.size())
    text.replace(at, word.size(), by);
  return text;
}

}  // namespace

std::shared_ptr<const LatticeNoise> LatticeNoise::of(Kind kind, std::uint32_t seed) {
  static std::mutex lock;
  static std::map<std::pair<Kind, std::uint32_t>, std::weak_ptr<const LatticeNoise>> all;
  const std::lock_guard guard(lock);
  std::weak_ptr<const LatticeNoise>& known = all[{kind, seed}];
  if (auto noise = known.lock()) return noise;
  const std::shared_ptr<const LatticeNoise> noise(new LatticeNoise(kind, seed));
  known = noise;
  return noise;
}

template <bool kWithGradient>
ValueAndGradient LatticeNoise::read(const glm::dvec3& p) const {
  if (std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z)) return {NAN, glm::dvec3(NAN)};
  const Place at = placeOf(p);
  ValueAndGradient f;
  if (kind_ == Kind::Value) {
    f = betweenNodes<false, kWithGradient>(seed_, at);
  } else if (kind_ == Kind::Gradient) {
    f = betweenNodes<true, kWithGradient>(seed_, at);
  } else {
    const TwoNearest nearest(at, seed_);
    f = lengthOf(kind_ == Kind::Nearest ? nearest.first : nearest.second);
    if (kind_ == Kind::Border) {
      const ValueAndGradient first = lengthOf(nearest.first);
      f = {f.value - first.value, f.gradient - first.gradient};
    }
  }
  for (int k = 0; k < 3; ++k)
    if (!(std::abs(p[k]) < kReach)) f.gradient[k] = 0.0;
  return f;
}

double LatticeNoise::value(const glm::dvec3& p) const { return read<false>(p).value; }

ValueAndGradient LatticeNoise::gradient(const glm::dvec3& p) const { return read<true>(p); }

double LatticeNoise::most() const { return kind_ <= Kind::Gradient ? 1.0 : std::sqrt(3.0); }

double LatticeNoise::lipschitz() const {
  return kind_ == Kind::Value ? 3.75 : kind_ == Kind::Gradient ? 3.84 : kind_ == Kind::Border ? 2.0 : 1.0;
}

Interval LatticeNoise::range(const std::array<Interval, 3>& box) const {
  glm::dvec3 lo, hi;
  for (int k = 0; k < 3; ++k) {
    if (box[k].nan) return {-most(), most(), true};
    lo[k] = std::clamp(box[k].lo, -kReach, kReach), hi[k] = std::clamp(box[k].hi, -kReach, kReach);
  }
  const double least = kind_ <= Kind::Gradient ? -most() : 0.0;
  const double middle = value(0.5 * (lo + hi)), reach = 0.5 * lipschitz() * glm::length(hi - lo),
               slack = 0x1p-40 * (1.0 + reach);
  return {std::max(least, middle - reach) - slack, std::min(most(), middle + reach) + slack, false};
}

std::string LatticeNoise::glsl(const std::string& name) const {
  std::string text = kHash;
  if (kind_ <= Kind::Gradient) {
    text += replaced(replaced(kNodes, "NODE", kind_ == Kind::Value ? kValue : kGradient), "SCALE",
                     kind_ == Kind::Value ? "1.0" : std::to_string(kScale));
  } else {
    const bool isFirst = kind_ == Kind::Nearest;
    const std::string value = isFirst                 ? "length(a)"
                              : kind_ == Kind::Second ? "length(b)"
                                                      : "length(b) - length(a)";
    const auto unit = [](const std::string& v) { return v + " / max(length(" + v + "), 1e-30)"; };
    const std::string slopes = isFirst                 ? unit("a")
                               : kind_ == Kind::Second ? unit("b")
                                                       : unit("b") + " - " + unit("a");
    std::string around;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        around +=
            "    NAMELook(cell, t, ivec3(" + std::to_string(x) + ", " + std::to_string(y) + ", z), f);\n";
    text += replaced(replaced(replaced(kCells, "AROUND", around), "VALUE", value), "SLOPES", slopes);
  }
  return replaced(replaced(text, "SEED", std::to_string(seed_)), "NAME", name);
}

}  // namespace sdf
