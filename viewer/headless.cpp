#include "viewer/headless.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "command_line/frames.h"
#include "command_line/progress_line.h"
#include "sdf/base/file.h"
#include "sdf/scene/relative.h"
#include "sdf/script/script.h"
#include "sdf/shape/catalog.h"
#include "sdf/triangles/mesh_field.h"
#include "viewer/comparison.h"
#include "viewer/gpu/context.h"
#include "viewer/gpu/picture.h"
#include "viewer/render/drawn_meshes.h"
#include "viewer/render/in_view.h"
#include "viewer/render/legend.h"
#include "viewer/render/mesh_view.h"
#include "viewer/render/present_scene.h"

namespace sdf::viewer {
namespace {

bool isClock(const ParameterInfo& parameter) { return parameter.name == "time"; }

Result<Scene> loadAt(double time, const Options& options) {
  return options.scene.load({.values = options.parameters, .time = time});
}

using command_line::ProgressLine;

// A warning, in the place of the line that is redrawn.
void warn(ProgressLine& progress, const std::string& text) {
  progress.clear();
  std::cerr << "sdfview: warning: " << text << '\n';
}

// Of a scene's formulas the steepest: rays take short steps where slopes are steep.
std::string steepestFormula(const Scene& scene) {
  const Shape* steepest = nullptr;
  const auto look = [&](const Shape& shape) {
    if (!shape.formulaAt.empty() && (!steepest || slopeOf(shape) > slopeOf(*steepest))) steepest = &shape;
  };
  for (const Part& part : scene.parts)
    if (isHardUnion(part.shape))
      std::ranges::for_each(part.shape.outer->operands, look);
    else
      look(part.shape);
  if (!steepest) return "";
  return "the formula in " + steepest->formulaAt + " has a slope of up to " + sdf::shown(slopeOf(*steepest)) +
         ", for which rays go in short steps" +
         (steepest->takesLipschitz ? ": give its field() the lipschitz that it has, if that is less; "
                                   : "; ");
}

class Headless {
 public:
  /// The eye is fitted to the box, if there is one.
  Headless(const Options& options, Scene scene, LookFunction look, const std::optional<Box>& fitTo,
           ProgressLine& progress)
      : options_(options),
        scene_(std::move(scene)),
        present_(options.scene, scene_, options.parameters, options.time),
        look_(std::move(look)),
        fitTo_(fitTo),
        progress_(progress) {}

  Status pictures() {
    const int count = options_.frames.value_or(1);
    for (int i = 0; i < count; ++i)
      if (auto s = checkTarget(nameOf(i)); !s) return s;
    if (options_.frames) progress_.setSubject("frame 1 of " + std::to_string(count));
    auto renderer = rendererAt(options_.time, options_.shader);
    if (!renderer) return renderer.error();
    auto target = Target::create(options_.width, options_.height, {PixelFormat::Rgba8});
    if (!target) return target.error();
    const bool scriptReadsTheClock = scene_.valuesRead.contains("time");
    const bool meshMoves = showsMesh(options_.shader.view) && std::ranges::any_of(scene_.parameters, isClock);
    for (int i = 0; i < count; ++i) {
      const double time = options_.time + i / options_.framesPerSecond;
      if (options_.frames)
        progress_.setSubject("frame " + std::to_string(i + 1) + " of " + std::to_string(count));
      if (i > 0 && scriptReadsTheClock) {
        progress_.beginStage("script");
        if (auto s = keep(loadAt(time, options_), scene_); !s) return s;
        look_ = LookFunction(scene_, look_.inView());
      }
      const Frame f = frame(time);
      const bool isFar = originFor(f.look.eye, renderer->origin()) != renderer->origin();
      if (i > 0 && (scriptReadsTheClock || meshMoves || isFar)) {
        renderer = rendererAt(time, options_.shader);
        if (!renderer) return renderer.error();
      } else if (auto s = moveTo(time, *renderer); !s) {
        return s;
      }
      progress_.beginStage("drawing");
      if (auto s = draw(*renderer, f, *target, nameOf(i)); !s) return s;
      if (auto s = write(*target, nameOf(i)); !s) return s;
      progress_.clear();
    }
    return okStatus();
  }

  Status bench(std::ostream& out, const std::string& driver) {
    auto renderer = rendererAt(options_.time, options_.shader);
    if (!renderer) return renderer.error();
    auto target = Target::create(options_.width, options_.height, {PixelFormat::Rgba8, PixelFormat::Rgba32f});
    if (!target) return target.error();
    const Frame f = frame(options_.time);
    std::vector<double> times;
    for (int i = 0; i <= *options_.bench; ++i) {
      const auto start = Clock::now();
      if (auto s = renderer->draw(f, *target); !s) return s;
      if (auto s = target->picture(); !s) return s.error();  // waits until all is drawn
      times.push_back(millisecondsSince(start));
    }
    const auto cpu = millisecondsBeforeDrawing(*renderer);
    if (!cpu) return cpu.error();
    const auto readings = readingsOn(*target);
    if (!readings) return readings.error();
    const auto drawn = target->picture();
    if (!drawn) return drawn.error();
    const double first = times.front();
    times.erase(times.begin());
    const double pixels = static_cast<double>(options_.width) * options_.height;
    nlohmann::ordered_json report{{"driver", driver},
                                  {"width", options_.width},
                                  {"height", options_.height},
                                  {"samples", options_.samples * options_.samples},
                                  {"compile_ms", renderer->compileSeconds() * 1e3},
                                  {"first_frame_ms", first},
                                  {"frame_ms", median(times)},
                                  {"cpu_ms", *cpu},
                                  {"shader_bytes", renderer->shaders().bytes()},
                                  {"lists", renderer->shaders().plan.cells.has_value()},
                                  {"readings_a_ray", *readings},
                                  {"rays", pixels * options_.samples * options_.samples},
                                  {"pixels_out_of_steps", pixelsOutOfSteps(*drawn)},
                                  {"pixels_out_of_shadow_steps", pixelsOutOfShadowSteps(*drawn)}};
    if (auto s = tellOfMeshes(renderer->shaders(), f, report); !s) return s;
    Contender own{std::move(*renderer), f};
    for (const Comparison& comparison : options_.comparisons)
      if (auto s = compareWith(comparison, own, *target, report); !s) return s;
    out << report.dump(2) << '\n';
    return okStatus();
  }

  Status shader() const {
    ShaderOptions whole = options_.shader;
    whole.sharing = false;
    whole.steps = Steps::BySlope;
    const auto shaders = assemble(sceneAt(options_.time), whole);
    if (!shaders) return shaders.error();
    if (auto s = checkTarget(*options_.glsl); !s) return s;
    return writeFile(*options_.glsl, [&](std::ostream& out) {
      out << shaders->picture.text;
      return okStatus();
    });
  }

 private:
  // What meshes of files cost, and how far off the samples of their distances are, in voxels.
  Status tellOfMeshes(const SceneShaders& shaders, const Frame& f, nlohmann::ordered_json& report) const {
    std::vector<std::shared_ptr<const MeshField>> fields;
    for (const ShaderVolume& volume : volumesOf(shaders)) {
      auto field = std::dynamic_pointer_cast<const MeshField>(volume.payload);
      if (field && std::ranges::find(fields, field) == fields.end()) fields.push_back(std::move(field));
    }
    for (const auto& field : fields) {
      const Bricks& bricks = field->bricks();
      report["fields"].push_back({{"triangles", field->mesh().triangles.size()},
                                  {"ready_ms", 1e3 * field->seconds()},
                                  {"voxel", bricks.voxel},
                                  {"bricks", bricks.count},
                                  {"error_max", bricks.worst / bricks.voxel},
                                  {"error_rms", bricks.rms / bricks.voxel}});
    }
    if (shaders.plan.drawn.empty()) return okStatus();
    auto meshes = DrawnMeshes::make(shaders);
    if (!meshes) return meshes.error();
    constexpr int kLayers = 4;  // as many as triangles fill
    auto target =
        Target::create(options_.width, options_.height, std::vector(kLayers, PixelFormat::Rgba32f), true);
    if (!target) return target.error();
    const glm::dvec3& origin = shaders.plan.options.origin;
    Frame near = f;
    near.look = relativeTo(f.look, origin);
    const Shot shot(near, options_.width, options_.height,
                    Extent(relativeTo(sceneAt(options_.time), origin)));
    meshes->prepare(f);
    std::vector<double> times;
    for (int i = 0; i <= *options_.bench; ++i) {
      target->clearDepth();
      finish();
      const auto start = Clock::now();
      const DrawingMode nearest = nearestWins();
      meshes->draw(shot);
      finish();
      times.push_back(millisecondsSince(start));
    }
    times.erase(times.begin());
    report["drawn_triangles"] = meshes->triangles();
    report["triangles_ms"] = median(times);
    return check("draw the triangles of meshes");
  }

  Status checkTarget(const std::filesystem::path& target) const {
    if (auto s = checkWritable(target); !s) return s;
    std::vector<std::string> read = scene_.files;
    read.push_back(options_.scene.path.string());
    if (options_.meshFile) read.push_back(options_.meshFile->string());
    return checkNotRead(target, read);
  }

  std::filesystem::path nameOf(int i) const {
    return options_.frames ? command_line::frameName(*options_.picture, i + 1) : *options_.picture;
  }

  Scene sceneAt(double time) const { return present_.at(scene_, options_.parameters, time); }

  // With the mesh of that moment, if its view shows one.
  Result<Renderer> rendererAt(double time, const ShaderOptions& shader) {
    ShaderOptions near = shader;
    near.origin = originFor(frame(time).look.eye);
    near.steps = present_.steps();
    progress_.beginStage("compiling shaders");
    auto renderer = Renderer::make(sceneAt(time), near, present_.other());
    if (renderer)
      for (const std::string& why : renderer->shaders().plan.doubtful)
        if (told_.insert(why).second) warn(progress_, why);
    if (!renderer || !showsMesh(shader.view)) return renderer;
    auto fixed = options_.scene.load({.values = options_.parameters, .time = time, .fixed = true});
    if (!fixed) return fixed.error();
    const MeshRequest request{options_.mesh, options_.meshFile, shader.view == View::Error};
    auto mesh = makeMeshView(std::move(*fixed), request, progress_);
    if (!mesh) return mesh.error();
    for (const std::string& warning : mesh->warnings) warn(progress_, warning);
    if (auto s = show(*mesh, *renderer); !s) return s.error();
    if (mesh->errors) figures_ = mesh->errors->figures;
    return renderer;
  }

  // Of the distance, by rays of each kind, in their share of the primary ones; drawn into the target.
  Result<nlohmann::ordered_json> readingsOn(const Target& target) {
    ShaderOptions counting = options_.shader;
    counting.countReadings = true;
    auto counter = rendererAt(options_.time, counting);
    if (!counter) return counter.error();
    if (auto s = counter->draw(frame(options_.time), target); !s) return s.error();
    const auto readings = counter->readings(target);
    if (!readings) return readings.error();
    return nlohmann::ordered_json{{"primary", readings->primary},
                                  {"shadow", readings->shadow},
                                  {"occlusion", readings->occlusion},
                                  {"reflection", readings->reflection}};
  }

  // Pictures are compared where they should be the same.
  Status compareWith(const Comparison& comparison, Contender& own, const Target& target,
                     nlohmann::ordered_json& report) const {
    Options options = options_;
    for (const auto& [name, value] : comparison.parameters) options.parameters[name] = value;
    options.shader.culling = options.shader.culling && comparison.culling;
    options.shader.start = comparison.start.value_or(options.shader.start);
    auto scene = loadAt(options.time, options);
    if (!scene) return scene.error();
    LookFunction look = lookOf(*scene, options.scene, options.parameters);
    Headless other(options, std::move(*scene), std::move(look), fitTo_, progress_);
    auto renderer = other.rendererAt(options.time, options.shader);
    if (!renderer) return renderer.error();
    Contender way{std::move(*renderer), other.frame(options.time)};
    const auto compared = compare(own, way, *options.bench, target);
    if (!compared) return compared.error();
    const auto readings = other.readingsOn(target);
    if (!readings) return readings.error();
    nlohmann::ordered_json figures{{"with", comparison.name},
                                   {"frame_ms", compared->milliseconds},
                                   {"other_frame_ms", compared->otherMilliseconds},
                                   {"ratio", compared->milliseconds / compared->otherMilliseconds},
                                   {"other_readings_a_ray", *readings}};
    if (comparison.parameters.empty()) figures["rms"] = compared->rms;
    report["compared"].push_back(std::move(figures));
    return okStatus();
  }

  Frame frame(double time) const {
    Values parameters = options_.parameters;
    parameters["time"] = time;
    const double aspect = static_cast<double>(options_.width) / options_.height;
    Look look = look_.at(parameters, aspect);
    if (options_.eye) look.eye = *options_.eye;
    if (fitTo_) look.eye = fitted(look.eye, *fitTo_, aspect);
    return options_.frame(std::move(parameters), std::move(look));
  }

  // Lets a renderer of the scene draw it with the slopes of this time.
  Status moveTo(double time, Renderer& renderer) {
    if (!present_.move(options_.parameters, time)) return okStatus();
    const auto followed = renderer.follow(sceneAt(time));
    return followed ? okStatus() : Status(followed.error());
  }

  // The median time that a frame of another moment takes on the CPU before anything is drawn.
  Result<double> millisecondsBeforeDrawing(Renderer& renderer) {
    const int frames = present_.inputs().contains("time") ? 11 : 101;
    std::vector<double> times;
    for (int i = 1; i <= frames; ++i) {
      const double time = options_.time + i / options_.framesPerSecond;
      const auto start = Clock::now();
      if (auto s = moveTo(time, renderer); !s) return s.error();
      renderer.prepare(frame(time));
      times.push_back(millisecondsSince(start));
    }
    if (auto s = moveTo(options_.time, renderer); !s) return s.error();
    return median(std::move(times));
  }

  Status draw(Renderer& renderer, const Frame& f, const Target& target,
              const std::filesystem::path& file) const {
    return options_.seconds ? refine(renderer, f, target, file) : renderer.draw(f, target);
  }

  // As the window does, with --samples if that is more.
  Status refine(Renderer& renderer, Frame f, const Target& target, const std::filesystem::path& file) const {
    f.samples = std::max(f.samples, usefulSamples(renderer.shaders().plan));
    const int all = f.samples * f.samples;
    const auto start = Clock::now();
    int drawn = 0;
    do {
      if (auto s = renderer.refine(f, drawn, target); !s) return s;
      finish();
      ++drawn;
    } while (drawn < all && millisecondsSince(start) < 1e3 * *options_.seconds);
    progress_.clear();
    std::cerr << "sdfview: " << file.string() << ": " << drawn << " of " << all << " samples a pixel\n";
    return okStatus();
  }

  // Alpha marks pixels that ran out of steps: told, not shown.
  Status write(const Target& target, const std::filesystem::path& file) const {
    auto drawn = target.picture();
    if (!drawn) return drawn.error();
    const std::size_t spent = pixelsOutOfSteps(*drawn), dark = pixelsOutOfShadowSteps(*drawn);
    for (std::size_t i = 3; i < drawn->bytes.size(); i += 4) drawn->bytes[i] = 255;
    if (spent > 0)
      warn(progress_, std::to_string(spent) + " pixels ran out of steps; " + steepestFormula(scene_) +
                          "give more with --steps, or see them with --view steps");
    if (dark > 0)
      warn(progress_, "in " + std::to_string(dark) +
                          " pixels the ray of a shadow ran out of steps and is taken for dark; the scene has "
                          "shadows{steps = " +
                          std::to_string(scene_.shadow.steps) + "}: give it more");
    if (figures_) drawLegend(*figures_, *drawn);
    return writePng(file, *drawn);
  }

  const Options& options_;
  Scene scene_;
  PresentScene present_;
  LookFunction look_;
  std::optional<Box> fitTo_;
  std::set<std::string> told_;  // warnings
  ProgressLine& progress_;
  std::optional<ErrorFigures> figures_;  // of the mesh, if its errors are shown
};

Status drawHeadless(const Options& options, std::ostream& out, ProgressLine& progress) {
  progress.beginStage("script");
  auto scene = loadAt(options.time, options);
  if (!scene) return scene.error();
  for (const std::string& note : scene->notes) warn(progress, note);
  for (const std::string& why : scene->missing) warn(progress, why + "; the rest is shown");
  LookFunction look = lookOf(*scene, options.scene, options.parameters);
  std::optional<Box> fitTo;
  if (options.fit)
    if (auto s = keep(boxInView(*scene, options.scene, options.parameters, options.time), fitTo); !s)
      return s;
  Headless headless(options, std::move(*scene), std::move(look), fitTo, progress);
  if (options.glsl)
    if (auto s = headless.shader(); !s) return s;
  if (!options.picture && !options.bench) return okStatus();
  auto context = Context::headless();
  if (!context) return context.error();
  if (options.picture)
    if (auto s = headless.pictures(); !s) return s;
  return options.bench ? headless.bench(out, (*context)->description()) : okStatus();
}

}  // namespace

Status runHeadless(const Options& options, std::ostream& out) {
  ProgressLine progress("sdfview", ProgressLine::shownOn(options.quiet));
  Status done = drawHeadless(options, out, progress);
  progress.clear();
  return done;
}

}  // namespace sdf::viewer
