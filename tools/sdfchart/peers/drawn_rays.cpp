#include "drawn_rays.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "opengl.h"
#include "sdf/scene/scene.h"
#include "viewer/render/renderer.h"

namespace sdf::chart {
namespace {

using viewer::Method;
using viewer::Renderer;
using viewer::Start;
using viewer::Target;

// The colour of each point is its place, and nothing changes that on its way into the picture.
Scene placesOf(const MarchedScene& marched) {
  Scene scene;
  scene.camera.from = Vec3E(marched.from);
  const double distance = glm::length(marched.from);
  scene.camera.fov = 2.0 * glm::degrees(std::atan(marched.radius / distance));
  scene.maxDistance = distance + 3.0 * marched.radius;
  scene.gamma = 1.0;
  scene.add("", Shape(marched.shape).paint({.color = position()}));
  return scene;
}

// What a pixel of such a picture tells.
RayStatus statusOf(const glm::vec4& pixel) {
  if (pixel.w < 1.0f) return RayStatus::Budget;
  const glm::vec3 nothing(0.1f);  // as kNothing of viewer/shaders/view_parts.h
  return glm::vec3(pixel) == nothing ? RayStatus::Miss : RayStatus::Hit;
}

// What may change without compiling.
struct Limits {
  double threshold;
  int steps;
};

// What draws one scene's rays by one method and from one start; shared by all thresholds and budgets.
class Drawing {
 public:
  Drawing(std::shared_ptr<KnownRays> known, int times, Method method, Start start)
      : known_(std::move(known)),
        times_(times),
        side_(times * known_->side()),
        method_(method),
        start_(start) {}

  double rays() const { return static_cast<double>(side_) * side_; }

  /// Draws a frame, and returns the seconds that it took; compiles first what is drawn with.
  double draw(const Limits& limits) {
    if (!renderer_) open();
    return secondsOf([&] {
      take(renderer_->draw(frame(limits), *target_));
      viewer::finish();
    });
  }

  /// What the known rays hit in the frame drawn last.
  Hits hits() const {
    const std::vector<glm::vec4> pixels = take(target_->pixels());
    const Rays& rays = known_->rays();
    Hits hits;
    for (int y = times_ / 2; y < side_; y += times_)
      for (int x = times_ / 2; x < side_; x += times_) {
        const std::size_t i = hits.t.size();
        const glm::vec4& pixel = pixels[static_cast<std::size_t>(y) * side_ + x];
        hits.t.push_back(glm::dot(glm::dvec3(pixel) - rays.origin[i], rays.direction[i]));
        hits.steps.push_back(0);  // readings() has their mean
        hits.status.push_back(statusOf(pixel));
      }
    return hits;
  }

  /// Readings a ray of such a frame, those of the cones included.
  double readings(const Limits& limits) {
    if (!counter_) counter_ = take(Renderer::make(scene_, options(true)));
    take(counter_->draw(frame(limits), *target_));
    return take(counter_->readings(*target_)).primary;
  }

  std::string driver() const { return "OpenGL: " + openedDriver().renderer; }
  KnownRays& known() const { return *known_; }

 private:
  viewer::ShaderOptions options(bool countReadings) const {
    return {
        .view = viewer::View::Material, .method = method_, .start = start_, .countReadings = countReadings};
  }
  void open() {
    openedDriver();
    scene_ = placesOf(known_->scene());
    renderer_ = take(Renderer::make(scene_, options(false)));
    target_ =
        take(Target::create(side_, side_, {viewer::PixelFormat::Rgba32f, viewer::PixelFormat::Rgba32f}));
  }
  viewer::Frame frame(const Limits& limits) const {
    viewer::Frame frame = viewer::frameOf(viewer::LookFunction(scene_), {}, 1.0);
    frame.filter = false;
    frame.threshold = limits.threshold;
    frame.maxSteps = limits.steps;
    return frame;
  }

  const std::shared_ptr<KnownRays> known_;
  const int times_, side_;
  const Method method_;
  const Start start_;
  Scene scene_;
  std::optional<Renderer> renderer_, counter_;
  std::optional<Target> target_;
};

Measurement measurement(const std::shared_ptr<Drawing>& drawing, Row row, const Limits& limits) {
  row.items = drawing->rays();
  return {row, [drawing, limits](Row* judged) {
            if (judged) drawing->draw(limits);  // warms up: compiles, and makes the targets
            const double seconds = drawing->draw(limits);
            if (judged) {
              judged->machine = drawing->driver();
              judgeHits(drawing->hits(), drawing->known().truth(), *judged);
              judged->evaluations = drawing->readings(limits);
              judged->truth = kSliver;
            }
            return seconds;
          }};
}

struct NamedWay {
  const char* name;
  Method method;
  Start start;
};
constexpr NamedWay kWays[] = {
    {"OpenGL, --start plain", Method::AutoRelaxed, Start::Plain},
    {"OpenGL, --start cone", Method::AutoRelaxed, Start::Cone},
    {"OpenGL, --start raster", Method::AutoRelaxed, Start::Raster},
    {"OpenGL, --method plain", Method::Plain, Start::Plain},  // which has no other start
};
const double kThresholds[] = {1.0, viewer::Frame{}.threshold, 1.0 / 16.0, 1.0 / 64.0};

bool isUsual(const NamedWay& way, const Limits& limits) {
  const viewer::ShaderOptions usual{};
  const viewer::Frame frame{};
  return way.method == usual.method && way.start == usual.start && limits.threshold == frame.threshold &&
         limits.steps == frame.maxSteps;
}

}  // namespace

std::vector<Measurement> drawnRays(const std::shared_ptr<KnownRays>& known, int times,
                                   const std::vector<int>& budgets) {
  std::vector<std::shared_ptr<Drawing>> drawings;
  for (const NamedWay& way : kWays)
    drawings.push_back(std::make_shared<Drawing>(known, times, way.method, way.start));
  std::vector<Measurement> all;
  for (const int steps : budgets)
    for (std::size_t i = 0; i < drawings.size(); ++i)
      for (const double threshold : kThresholds) {
        Row row{.kind = "marching",
                .scene = budgetName(known->scene().name + ", OpenGL", steps),
                .method = kWays[i].name,
                .setting = formatted("%g of a pixel's cone", threshold),
                .size = threshold};
        row.isDefault = isUsual(kWays[i], {threshold, steps});
        all.push_back(measurement(drawings[i], row, {threshold, steps}));
      }
  return all;
}

}  // namespace sdf::chart
