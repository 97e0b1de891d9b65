// A fragment shader as found on the web beside our picture of the same scene, in the same OpenGL: how much
// alike they look, how long each takes, and which of them is nearer to the scene itself. Prints JSON.
#include <epoxy/gl.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <sstream>

#include "sdf/script/script.h"
#include "viewer/gpu/context.h"
#include "viewer/gpu/picture.h"
#include "viewer/render/psnr.h"
#include "viewer/render/renderer.h"

namespace sdf::viewer {
namespace {

using Colors = std::vector<glm::dvec3>;

struct Options {
  std::string shader, scene, size = "640x360", pictures;
  double time = 0.0;
  int frames = 31;
  bool reference = false;
};

template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}
void must(const Status& status) {
  if (!status) throw std::runtime_error(status.error().message);
}

std::string textOf(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The found shader as a core one that takes side x side samples a pixel.
std::string coreShader(std::string found, int side) {
  const bool toy = found.find("mainImage") != std::string::npos;
  for (const auto& [name, replacement] :
       {std::pair("\\bgl_FragColor\\b", "foundColor"), std::pair("\\bgl_FragCoord\\b", "foundCoord"),
        std::pair("\\bvoid\\s+main\\b", "void foundMain")})
    found = std::regex_replace(found, std::regex(name), replacement);
  const std::string before =
      toy ? "uniform vec3 iResolution;\nuniform float iTime;\n" : "vec4 foundColor, foundCoord;\n";
  const std::string call = toy ? "vec4 foundColor;\n    mainImage(foundColor, at);"
                               : "foundCoord = vec4(at, 0.0, 1.0);\n    foundMain();";
  return "#version 330 core\n" + before + found + "\nconst int SIDE = " + std::to_string(side) +
         R"(;
layout(location = 0) out vec4 shown;
void main() {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < SIDE * SIDE; ++i) {
    vec2 at = floor(gl_FragCoord.xy) + (vec2(float(i % SIDE), float(i / SIDE)) + 0.5) / float(SIDE);
    )" + call +
         R"(
    sum += foundColor.rgb;
  }
  shown = vec4(sum / float(SIDE * SIDE), 1.0);
}
)";
}

class Comparison {
 public:
  explicit Comparison(const Options& options) : options_(options), scene_(load(options)) {
    if (std::sscanf(options.size.c_str(), "%dx%d", &width_, &height_) != 2)
      throw std::runtime_error("--size needs WIDTHxHEIGHT");
  }

  nlohmann::ordered_json run() {
    const std::string found = textOf(options_.shader);
    Program theirs = program(found, 1);
    Renderer ours = must(Renderer::make(scene_));
    const Target target = must(Target::create(width_, height_, {PixelFormat::Rgba8}));
    const Frame frame = frameOf(LookFunction(scene_), {{"time", options_.time}});
    const auto drawTheirs = [&] {
      target.bind();
      theirs.draw();
    };
    const auto drawOurs = [&] { must(ours.draw(frame, target)); };
    const Colors our = colors(target, drawOurs), their = colors(target, drawTheirs);
    save("ours", our);
    save("theirs", their);
    saveDifference("difference", our, their);
    nlohmann::ordered_json result{{"width", width_}, {"height", height_}, {"psnr", test::psnr(our, their)}};
    {
      const Program smooth = program(found, 6);
      const Colors their36 = colors(target, [&] {
        target.bind();
        smooth.draw();
      });
      save("theirs36", their36);
      saveDifference("difference36", our, their36);
      result["psnr_36_samples"] = test::psnr(our, their36);
      Frame smoothFrame = frame;
      smoothFrame.samples = 6;
      result["psnr_both_36_samples"] =
          test::psnr(colors(target, [&] { must(ours.draw(smoothFrame, target)); }), their36);
    }
    const auto [theirMs, ourMs] = times(drawTheirs, drawOurs);
    result["their_ms"] = theirMs;
    result["our_ms"] = ourMs;
    result["times_faster"] = theirMs / ourMs;
    if (options_.reference) {
      const Colors truth = reference(target);
      save("reference", truth);
      result["their_psnr_to_reference"] = test::psnr(their, truth);
      result["our_psnr_to_reference"] = test::psnr(our, truth);
    }
    return result;
  }

 private:
  static Scene load(const Options& options) {
    ScriptOptions script;
    script.time = options.time;
    return must(loadScene(options.scene, script));
  }

  Program program(const std::string& found, int side) const {
    Program::strict = false;  // a found shader declares what it likes
    Program made = must(Program::overScreen(coreShader(found, side)));
    made.set("u_resolution", glm::vec2(width_, height_));
    made.set("u_time", static_cast<float>(options_.time));
    made.set("iResolution", glm::vec3(width_, height_, 1.0f));
    made.set("iTime", static_cast<float>(options_.time));
    return made;
  }

  // Waits until all is drawn.
  Colors colors(const Target& target, const std::function<void()>& draw) const {
    draw();
    Colors result;
    for (const glm::vec4& pixel : must(target.pixels())) result.emplace_back(pixel);
    return result;
  }

  // Medians of frames drawn in turn, in milliseconds.
  std::pair<double, double> times(const std::function<void()>& a, const std::function<void()>& b) const {
    const auto once = [](const std::function<void()>& draw) {
      const auto start = std::chrono::steady_clock::now();
      draw();
      glFinish();
      return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    };
    std::vector<double> as, bs;
    for (int i = 0; i < options_.frames; ++i) {
      as.push_back(once(a));
      bs.push_back(once(b));
    }
    const auto median = [](std::vector<double>& v) {
      std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
      return v[v.size() / 2];
    };
    return {median(as), median(bs)};
  }

  // Our scene, marched closely and without what makes it fast, 64 samples a pixel.
  Colors reference(const Target& target) const {
    Renderer plain = must(Renderer::make(scene_, {.method = Method::Plain}));
    Frame frame = frameOf(LookFunction(scene_), {{"time", options_.time}});
    frame.samples = 8;
    frame.maxSteps = 500;
    frame.epsilon = 1e-5;
    frame.threshold = 0.0;
    return colors(target, [&] { must(plain.draw(frame, target)); });
  }

  void save(const std::string& name, const Colors& picture) const {
    if (options_.pictures.empty()) return;
    Picture png{width_, height_, 3, {}};
    for (const glm::dvec3& c : picture)
      for (int k = 0; k < 3; ++k)
        png.bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(c[k], 0.0, 1.0))));
    must(writePng(options_.pictures + name + ".png", png));
  }

  // Eight times as strong, so that what the eye would miss is seen.
  void saveDifference(const std::string& name, const Colors& a, const Colors& b) const {
    Colors difference;
    for (std::size_t i = 0; i < a.size(); ++i) difference.push_back(8.0 * glm::abs(a[i] - b[i]));
    save(name, difference);
  }

  const Options& options_;
  Scene scene_;
  int width_ = 0, height_ = 0;
};

int run(const Options& options) {
  const auto context = must(Context::headless());
  auto result = Comparison(options).run();
  result["driver"] = context->description();
  std::cout << result.dump(2) << '\n';
  return 0;
}

}  // namespace
}  // namespace sdf::viewer

int main(int argc, char** argv) {
  CLI::App app("Compares a shader found on the web with our picture of a scene.", "compare_shader");
  sdf::viewer::Options options;
  app.add_option("SHADER", options.shader, "main() with u_resolution, or Shadertoy's mainImage")->required();
  app.add_option("SCENE", options.scene, "scene file (Lua)")->required();
  app.add_option("--size", options.size, "WIDTHxHEIGHT [640x360]");
  app.add_option("--time", options.time, "seconds [0]");
  app.add_option("--frames", options.frames, "frames of each that are timed [31]")
      ->check(CLI::Range(1, 10000));
  app.add_option("--pictures", options.pictures, "save what was compared under names that begin so");
  app.add_flag("--reference", options.reference, "compare both with the scene drawn with great care");
  CLI11_PARSE(app, argc, argv);
  try {
    return sdf::viewer::run(options);
  } catch (const std::exception& error) {
    std::cerr << "compare_shader: " << error.what() << '\n';
    return 1;
  }
}
