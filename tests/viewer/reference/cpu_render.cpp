#include "viewer/reference/cpu_render.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "sdf/eval/scalar_reading.h"
#include "sdf/march/ambient_occlusion.h"
#include "sdf/march/normals.h"
#include "sdf/march/shadow.h"
#include "sdf/scene/background_light.h"
#include "sdf/scene/fit.h"
#include "viewer/reference/cpu_camera.h"
#include "viewer/reference/cpu_uniform.h"

namespace sdf::test {
namespace {

constexpr double kMirrorStart = 0.02;    // where a mirrored ray leaves the surface
constexpr double kShadowEpsilon = 1e-3;  // a shadow ray hits here, or at half its start if that is less

template <class T>
T take(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

struct PresentLight {
  bool isPoint, castsShadow;
  glm::dvec3 vector, color;  // the colour times the intensity
  double size;               // its radius, or the sine of half the angle that it is seen under
};

// The scene with every formula read that can be: what all threads share.
struct Present {
  MarchField field, shadeField;
  MarchOptions march;
  TapePtr surface, background;
  std::vector<PresentLight> lights;
  BackgroundLight around;
  glm::dvec3 ambient, fogColor;
  double fogDensity, sharpness, occlusionStrength;

  Present(const Scene& scene, const CpuRenderOptions& options)
      : march(options.march),
        around(backgroundLight(scene)),
        ambient(uniform(scene.ambient)),
        fogColor(uniform(scene.fog.color)),
        fogDensity(uniformValue(scene.fog.density)),
        sharpness(uniformValue(scene.shadow.sharpness)),
        occlusionStrength(uniformValue(scene.ambientOcclusion.strength)) {
    const Shape whole = scene.whole();
    field = shadeField = take(marchField(whole));
    if (!field.hasSlope()) shadeField = marchField(whole.distance, 1.0);  // it shades as it stands
    if (scene.ambientOcclusion.kind == AmbientOcclusion::Kind::Steps) march.method = MarchMethod::Plain;
    if (!field.hasSlope()) march.method = MarchMethod::Bisection;
    surface = std::make_shared<const Tape>(whole.surface);
    const Expr sky[] = {scene.background.x, scene.background.y, scene.background.z};
    background = std::make_shared<const Tape>(sky);
    for (const Light& l : scene.lights) {
      const bool isPoint = l.kind == Light::Kind::Point;
      const double radius = uniformValue(l.radius);
      lights.push_back({isPoint, l.castsShadow, uniform(l.vector),
                        uniform(l.color) * uniformValue(l.intensity),
                        isPoint ? radius : std::sin(glm::radians(radius))});
    }
  }
};

// Where some of the rays met the surface.
struct Surface {
  std::vector<std::size_t> ray;  // which they are
  Vectors points, normals;
  std::vector<std::array<double, kAttributeCount>> attributes;

  double get(std::size_t i, Attribute a) const { return attributes[i][static_cast<int>(a)]; }
  glm::dvec3 color(std::size_t i, Attribute red) const {
    const double* c = &attributes[i][static_cast<int>(red)];
    return {c[0], c[1], c[2]};
  }
};

// Of each ray the places in the unit square that choose a direction of a glossy mirror's lobe, a point of
// each light and one of the lens.
struct Choice {
  glm::dvec2 lobe, light, lens;
};
using Choices = std::vector<Choice>;

// A direction at this angle to an axis.
glm::dvec3 around(const glm::dvec3& axis, double cosine, double sine, double turn) {
  const glm::dvec3 aside = std::abs(axis.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 across = glm::normalize(glm::cross(axis, aside)), up = glm::cross(axis, across);
  const double angle = 2.0 * std::numbers::pi * turn;
  return cosine * axis + sine * (std::cos(angle) * across + std::sin(angle) * up);
}

struct Seen {
  std::vector<glm::dvec3> radiance, normal;
  Hits hits;
};

// One thread's means of looking along rays.
class Eye {
 public:
  Eye(const Scene& scene, const Present& present)
      : scene_(scene),
        lengths_(viewLengths(scene, std::nullopt)),
        now_(present),
        marcher_(take(Marcher::make(present.field, present.march))) {}

  Seen look(const Rays& rays, const Choices& choices, int bouncesLeft) {
    Seen seen{{}, std::vector<glm::dvec3>(rays.size(), glm::dvec3(0.0)), take(marcher_.trace(rays))};
    for (std::size_t i = 0; i < rays.size(); ++i) seen.radiance.push_back(background(rays.direction[i]));
    const Surface surface = surfaceAt(rays, seen.hits);
    std::vector<glm::dvec3> color = local(rays, choices, surface, seen.hits);
    if (bouncesLeft > 0) addMirrored(rays, choices, surface, bouncesLeft, color);
    for (std::size_t i = 0; i < surface.ray.size(); ++i) {
      const std::size_t ray = surface.ray[i];
      const double kept = std::exp(-now_.fogDensity * seen.hits.t[ray]);
      seen.radiance[ray] = glm::mix(now_.fogColor, color[i], kept);
      seen.normal[ray] = surface.normals[i];
    }
    return seen;
  }

 private:
  glm::dvec3 background(const glm::dvec3& d) {
    reading_.run(*now_.background, {d.x, d.y, d.z, 0.0, 0.0, 0.0});
    return {reading_.output(0), reading_.output(1), reading_.output(2)};
  }

  Surface surfaceAt(const Rays& rays, const Hits& hits) {
    Surface s;
    Vectors back;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits.status[i] != RayStatus::Hit) continue;
      s.ray.push_back(i);
      s.points.add(rays.at(i, hits.t[i]));
      back.add(-rays.direction[i]);
    }
    s.normals = take(normals(now_.field, s.points, back, {}));
    s.attributes.resize(s.ray.size());
    for (std::size_t i = 0; i < s.ray.size(); ++i) {
      const glm::dvec3 p = s.points[i], n = s.normals[i];
      reading_.run(*now_.surface, {p.x, p.y, p.z, n.x, n.y, n.z});
      for (int a = 0; a < kAttributeCount; ++a) s.attributes[i][a] = reading_.output(a);
    }
    return s;
  }

  // What the surface sends back along the rays, mirrors aside.
  std::vector<glm::dvec3> local(const Rays& rays, const Choices& choices, const Surface& s,
                                const Hits& hits) const {
    const std::vector<double> open = tapOcclusion(s);
    std::vector<glm::dvec3> color;
    for (std::size_t i = 0; i < s.ray.size(); ++i)
      color.push_back((now_.ambient + now_.around.at(s.normals[i])) * s.color(i, Attribute::AmbientRed) *
                          open[i] +
                      s.color(i, Attribute::EmissionRed));
    for (const PresentLight& light : now_.lights) addLight(light, rays, choices, s, color);
    if (scene_.ambientOcclusion.kind == AmbientOcclusion::Kind::Steps) darkenBySteps(s, hits, color);
    return color;
  }

  std::vector<double> tapOcclusion(const Surface& s) const {
    const AmbientOcclusion& o = scene_.ambientOcclusion;
    if (o.kind != AmbientOcclusion::Kind::Taps) return std::vector<double>(s.ray.size(), 1.0);
    const TapOptions options{o.count, lengths_.tapSpacing, now_.occlusionStrength, TapWeights::Relative};
    return take(occlusionByTaps(now_.shadeField, s.points, s.normals, options));
  }

  void darkenBySteps(const Surface& s, const Hits& hits, std::vector<glm::dvec3>& color) const {
    std::vector<int> steps;
    for (const std::size_t ray : s.ray) steps.push_back(hits.steps[ray]);
    const std::vector<double> open = take(occlusionBySteps(steps, now_.occlusionStrength));
    for (std::size_t i = 0; i < color.size(); ++i) color[i] *= open[i];
  }

  // Phong, "Illumination for computer generated pictures", 1975.
  void addLight(const PresentLight& light, const Rays& rays, const Choices& choices, const Surface& s,
                std::vector<glm::dvec3>& color) const {
    const std::vector<double> arriving = shadowOf(light, choices, s);
    for (std::size_t i = 0; i < s.ray.size(); ++i) {
      const glm::dvec3 n = s.normals[i], d = rays.direction[s.ray[i]];
      const glm::dvec3 l = glm::normalize(light.isPoint ? light.vector - s.points[i] : light.vector);
      const double cosine = glm::dot(n, l);
      const glm::dvec3 r = 2.0 * cosine * n - l;
      const double shine = std::pow(std::max(glm::dot(r, -d), 0.0), s.get(i, Attribute::Shininess));
      color[i] +=
          light.color * arriving[i] *
          (s.color(i, Attribute::Red) * std::max(cosine, 0.0) + s.color(i, Attribute::SpecularRed) * shine);
    }
  }

  std::vector<double> shadowOf(const PresentLight& light, const Choices& choices, const Surface& s) const {
    const Shadow& shadow = scene_.shadow;
    if (shadow.kind == Shadow::Kind::None || !light.castsShadow)
      return std::vector<double>(s.ray.size(), 1.0);
    // The kinds after None are the methods, in their order.
    const auto method =
        light.size > 0.0 ? ShadowMethod::Hard : static_cast<ShadowMethod>(static_cast<int>(shadow.kind) - 1);
    const double start = lengths_.shadowStart, reach = lengths_.shadowReach;
    const ShadowOptions options{method, now_.sharpness, std::min(kShadowEpsilon, 0.5 * start), shadow.steps};
    Rays way = light.size > 0.0 ? raysInto(light, choices, s)
               : light.isPoint  ? raysToPoint(s.points, light.vector, start)
                                : raysTowards(s.points, light.vector, start, reach);
    for (double& end : way.tMax) end = std::min(end, std::max(start, reach));
    return take(shadows(now_.shadeField, way, options)).light;
  }

  // One to a point of a light that has a size, uniform in the solid angle that it fills; up to the ball.
  Rays raysInto(const PresentLight& light, const Choices& choices, const Surface& s) const {
    Rays way;
    for (std::size_t i = 0; i < s.ray.size(); ++i) {
      const glm::dvec3 towards = light.isPoint ? light.vector - s.points[i] : light.vector;
      const double far = glm::length(towards),
                   rim = light.isPoint ? std::min(light.size / far, 1.0) : light.size;
      const glm::dvec2 u = choices[s.ray[i]].light;
      const double cosine = 1.0 - u.x * (1.0 - std::sqrt(1.0 - rim * rim));
      const double sine = std::sqrt(1.0 - cosine * cosine), start = lengths_.shadowStart;
      const double half = std::sqrt(std::max(light.size * light.size - far * far * sine * sine, 0.0));
      const double end = light.isPoint ? std::max(start, far * cosine - half) : lengths_.shadowReach;
      way.add(s.points[i], glm::normalize(around(towards / far, cosine, sine, u.y)), start, end);
    }
    return way;
  }

  void addMirrored(const Rays& rays, const Choices& choices, const Surface& s, int bouncesLeft,
                   std::vector<glm::dvec3>& color) {
    Rays mirrored;
    Choices theirs;
    std::vector<std::size_t> of;
    std::vector<glm::dvec3> weight;
    for (std::size_t i = 0; i < s.ray.size(); ++i) {
      const glm::dvec3 n = s.normals[i], d = rays.direction[s.ray[i]];
      const glm::dvec3 w = mirrorWeight(s, i, std::max(glm::dot(-d, n), 0.0));
      if (w == glm::dvec3(0.0)) continue;
      of.push_back(i);
      weight.push_back(w);
      const glm::dvec3 m = glm::normalize(glm::reflect(d, n));
      const glm::dvec2 u = choices[s.ray[i]].lobe;
      const double exponent = s.get(i, Attribute::Shininess);
      theirs.push_back(choices[s.ray[i]]);
      mirrored.add(s.points[i], scene_.glossyReflections ? inLobe(m, n, exponent, u) : m, kMirrorStart,
                   lengths_.maxDistance);
    }
    if (of.empty()) return;
    const Seen seen = look(mirrored, theirs, bouncesLeft - 1);
    for (std::size_t k = 0; k < of.size(); ++k)
      color[of[k]] = glm::mix(color[of[k]], seen.radiance[k], weight[k]);
  }

  // Around m, with the cosine's density (exponent + 1) / (2 pi) cos^exponent; mirrored at the surface if it
  // is behind.
  static glm::dvec3 inLobe(const glm::dvec3& m, const glm::dvec3& n, double exponent, const glm::dvec2& u) {
    const double cosine = std::pow(u.x, 1.0 / (exponent + 1.0));
    const glm::dvec3 way = around(m, cosine, std::sqrt(1.0 - cosine * cosine), u.y);
    return glm::normalize(way - std::min(2.0 * glm::dot(way, n), 0.0) * n);
  }

  // Schlick, "An inexpensive BRDF model for physically-based rendering", 1994, with power and bias free.
  // Straight on a mirror has the highlight's tint.
  static glm::dvec3 mirrorWeight(const Surface& s, std::size_t i, double cosine) {
    const double power = s.get(i, Attribute::FresnelPower);
    const glm::dvec3 specular = s.color(i, Attribute::SpecularRed);
    const double peak = std::max({specular.x, specular.y, specular.z});
    const glm::dvec3 tint = peak > 0.0 ? specular / peak : glm::dvec3(1.0);
    const glm::dvec3 grazing = power == 0.0 ? tint : glm::dvec3(std::pow(1.0 - cosine, power));
    return glm::min(s.get(i, Attribute::Reflectivity) * (s.get(i, Attribute::FresnelBias) * tint + grazing),
                    1.0);
  }

  const Scene& scene_;
  ViewLengths lengths_;
  const Present& now_;
  Marcher marcher_;
  ScalarReading<double> reading_;
};

Picture blank(int width, int height) {
  const std::size_t count = static_cast<std::size_t>(width) * height;
  const glm::dvec3 nothing(0.0);
  return {width,
          height,
          std::vector<glm::dvec3>(count, nothing),
          std::vector<double>(count),
          std::vector<RayStatus>(count),
          std::vector<glm::dvec3>(count, nothing)};
}

// Bayer's pattern of 8 by 8, counted from the lower left as OpenGL does.
unsigned bayer(unsigned x, unsigned y) {
  x ^= y;
  return (x & 1u) << 5u | (y & 1u) << 4u | (x & 2u) << 2u | (y & 2u) << 1u | (x & 4u) >> 1u | (y & 4u) >> 2u;
}

// Those of a row's samples in the order of raysOfRow: places by Roberts's sequences, shifted in each pixel.
Choices choicesOfRow(const CpuRenderOptions& o, int row) {
  Choices choices;
  for (int column = 0; column < o.width; ++column) {
    const unsigned place = bayer(static_cast<unsigned>(column), static_cast<unsigned>(o.height - 1 - row));
    const glm::dvec2 shift((place + 0.5) / 64.0, (place * 29 % 64 + 0.5) / 64.0);
    const auto placeOf = [&](int sample, double x, double y) {
      return glm::fract(shift + double(sample) * glm::dvec2(x, y));
    };
    for (int sample = 0; sample < o.samples * o.samples; ++sample)
      choices.push_back({placeOf(sample, 0.7548776662466927, 0.5698402909980532),
                         placeOf(sample, 0.733891856627126, 0.6287067210378087),
                         placeOf(sample, 0.8566748838545029, 0.5385972572236101)});
  }
  return choices;
}

// A ray through a point of the picture; with a lens from one of its points, to where that of the pinhole
// meets what is in focus.
void addRay(const Scene& scene, const Pinhole& camera, const glm::dvec2& at, const glm::dvec2& u,
            Rays& rays) {
  const double radius = uniformValue(scene.camera.aperture), turn = 2.0 * std::numbers::pi * u.y;
  const double focus = scene.camera.focus ? uniformValue(*scene.camera.focus)
                                          : glm::length(uniform(scene.camera.to) - camera.from());
  const glm::dvec3 d = camera.through(at.x, at.y);
  const glm::dvec3 off = radius * std::sqrt(u.x) * camera.aside({std::cos(turn), std::sin(turn)});
  const glm::dvec3 sharp = focus / glm::dot(d, camera.ahead()) * d;
  rays.add(camera.from() + off, radius > 0.0 ? glm::normalize(sharp - off) : d, 0.0,
           viewLengths(scene, std::nullopt).maxDistance);
}

// The samples of a row's pixels, n * n of each together, from left to right and from the bottom.
Rays raysOfRow(const Scene& scene, const CpuRenderOptions& o, int row, const Choices& choices) {
  Rays rays;
  const Pinhole camera(scene.camera, o.width, o.height);
  const auto within = [&](int i, int sample) { return i + (sample + 0.5) / o.samples; };
  for (int column = 0; column < o.width; ++column)
    for (int sample = 0; sample < o.samples * o.samples; ++sample)
      addRay(scene, camera,
             {within(column, sample % o.samples), within(row, o.samples - 1 - sample / o.samples)},
             choices[rays.size()].lens, rays);
  return rays;
}

void drawRow(const Scene& scene, const CpuRenderOptions& o, Eye& eye, int row, Picture& picture) {
  const std::size_t each = static_cast<std::size_t>(o.samples) * o.samples;
  const int half = o.samples / 2;
  const std::size_t middle = static_cast<std::size_t>((o.samples - 1 - half) * o.samples + half);
  const Choices choices = choicesOfRow(o, row);
  const Seen seen = eye.look(raysOfRow(scene, o, row, choices), choices, scene.reflectionBounces);
  for (int column = 0; column < o.width; ++column) {
    const std::size_t pixel = picture.at(column, row), first = each * column;
    for (std::size_t k = 0; k < each; ++k)
      picture.color[pixel] += seen.radiance[first + k] / static_cast<double>(each);
    picture.depth[pixel] = seen.hits.t[first + middle];
    picture.status[pixel] = seen.hits.status[first + middle];
    picture.normal[pixel] = seen.normal[first + middle];
  }
}

// IEC 61966-2-1.
double encodeSrgb(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055; }

}  // namespace

Picture renderOnCpu(const Scene& scene, const CpuRenderOptions& options) {
  const Present present(scene, options);
  Picture picture = blank(options.width, options.height);
  const unsigned count = std::max(1u, std::thread::hardware_concurrency());
  std::atomic<int> next = 0;
  std::vector<std::exception_ptr> failures(count);
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < count; ++i)
    threads.emplace_back([&, i] {
      try {
        Eye eye(scene, present);
        for (int row = next++; row < options.height; row = next++) drawRow(scene, options, eye, row, picture);
      } catch (...) {
        failures[i] = std::current_exception();
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
  return picture;
}

glm::dvec3 toned(const glm::dvec3& linear, Tone tone) {
  if (tone == Tone::Linear) return linear;
  const glm::dvec3 c = glm::max(linear, 0.0);
  return glm::min(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 1.0);
}

glm::dvec3 encode(const glm::dvec3& linear, const std::optional<double>& gamma) {
  glm::dvec3 shown;
  for (int i = 0; i < 3; ++i) {
    const double c = std::clamp(linear[i], 0.0, 1.0);
    shown[i] = gamma ? std::pow(c, 1.0 / *gamma) : encodeSrgb(c);
  }
  return shown;
}

std::vector<glm::dvec3> encode(const std::vector<glm::dvec3>& linear, const std::optional<double>& gamma) {
  std::vector<glm::dvec3> shown;
  for (const glm::dvec3& c : linear) shown.push_back(encode(c, gamma));
  return shown;
}

}  // namespace sdf::test
