#include "viewer/options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>

#include "command_line/frames.h"
#include "sdf/base/version.h"

namespace sdf::viewer {

using namespace command_line;  // NOLINT: this file is about nothing else

namespace {

constexpr std::array kViews{"picture",  "normals",  "steps",     "slice",
                            "gradient", "material", "occlusion", "shadow"};
static_assert(kViews.size() == static_cast<std::size_t>(View::Count));
constexpr std::array kMethods{"auto", "plain"};

/// The command line's words, before they are looked at closer.
struct Words {
  std::string scene;
  std::optional<std::string> picture, glsl, size, samples, steps, time, frames, fps, view, method, camera,
      bench;
  std::vector<std::string> parameters;
};

void declare(CLI::App& app, Words& words) {
  app.add_option("SCENE", words.scene, "scene file (Lua)")->required()->type_name("");
  const auto add = [&](const char* flag, auto& word, const char* value, const char* what) {
    return app.add_option(flag, word, what)->type_name(value);
  };
  add("--render", words.picture, "OUT.png", "draw into this file, without a window");
  add("--size", words.size, "WxH", "of the picture in pixels [1280x720]");
  add("-t,--time", words.time, "T", "the scene's time in seconds [0]");
  add("--samples", words.samples, "N", "samples a pixel: 1, 4, 9, ... [1]");
  add("--steps", words.steps, "N", "readings of the distance that a ray may take [1024]");
  add("--view", words.view, "NAME",
      "picture, normals, steps, slice, gradient, material, occlusion or shadow");
  add("--method", words.method, "NAME", "how rays are marched: auto (auto-relaxed) or plain");
  add("-D", words.parameters, "name=value", "set a parameter of the scene; may be repeated")
      ->allow_extra_args(false);
  add("--camera", words.camera, "x,y,z,x,y,z[,fov]",
      "where the camera stands and looks, and its field of view");
  add("--frames", words.frames, "N", "draw N pictures, OUT_0001.png and so on, or wherever OUT has %04d");
  add("--fps", words.fps, "F", "frames a second [24]");
  add("--bench", words.bench, "N", "draw N frames and print as JSON what they cost");
  add("--glsl", words.glsl, "OUT.glsl", "write the shader that draws the scene");
  app.footer(
      "Without --render, --bench and --glsl a window opens.\n"
      "Exit status: 0 done, 2 usage, 3 scene, 4 limits, 5 files, 6 graphics, 130 interrupted.");
}

/// The place of a word in a list of names.
template <class Enum, std::size_t n>
Status choose(const char* flag, const std::optional<std::string>& word,
              const std::array<const char*, n>& names, Enum& value) {
  if (!word) return okStatus();
  std::string list;
  for (std::size_t i = 0; i < n; ++i) {
    if (*word == names[i]) {
      value = static_cast<Enum>(i);
      return okStatus();
    }
    list += (i == 0 ? "" : i + 1 == n ? " or " : ", ") + std::string(names[i]);
  }
  return usage(std::string(flag) + " needs " + list + ", got '" + *word + "'");
}

Status size(const std::optional<std::string>& word, int& width, int& height) {
  if (!word) return okStatus();
  const std::size_t cross = word->find('x');
  const auto side = [](const std::optional<double>& v) {
    return v && *v >= 1.0 && *v <= 65536.0 && *v == std::floor(*v);
  };
  const auto w = number(word->substr(0, cross));
  const auto h = cross == std::string::npos ? std::nullopt : number(word->substr(cross + 1));
  if (!side(w) || !side(h))
    return usage("--size needs WIDTHxHEIGHT in whole pixels from 1, got '" + *word + "'");
  width = static_cast<int>(*w);
  height = static_cast<int>(*h);
  return okStatus();
}

Status samples(const std::optional<std::string>& word, int& side) {
  if (!word) return okStatus();
  const auto n = number(*word);
  const double root = n ? std::sqrt(*n) : 0.0;
  if (!(root >= 1.0 && root <= 32.0 && root == std::floor(root)))
    return usage("--samples needs a square from 1 to 1024 (1, 4, 9, ...), got '" + *word + "'");
  side = static_cast<int>(root);
  return okStatus();
}

Status camera(const std::optional<std::string>& word, std::optional<Eye>& eye) {
  if (!word) return okStatus();
  const std::vector<double> v = numbers(*word);
  const auto wrong = [&](const std::string& needs) {
    return usage("--camera needs " + needs + ", got '" + *word + "'");
  };
  if (v.size() != 6 && v.size() != 7)
    return wrong("six numbers x,y,z,x,y,z, or seven with the field of view");
  eye.emplace();
  eye->from = {v[0], v[1], v[2]};
  eye->to = {v[3], v[4], v[5]};
  if (eye->from == eye->to) return wrong("two different places");
  if (v.size() == 7) eye->fov = v[6];
  if (!(eye->fov > 0.0 && eye->fov < 180.0)) return wrong("a field of view between 0 and 180 degrees");
  eye = upright(*eye);
  return okStatus();
}

Status checkSequence(const Words& words) {
  if (words.frames) {
    if (!words.picture) return usage("--frames says how many pictures --render OUT.png draws; add --render");
    return checkFrameName(*words.picture);
  }
  if (words.fps) return usage("--fps says how fast --frames N go by; add --frames or leave --fps out");
  return okStatus();
}

Result<Options> interpreted(const Words& words) {
  Options options;
  options.scene = words.scene;
  options.picture = words.picture;
  options.glsl = words.glsl;
  const auto whole = [](const char* flag) {
    return [flag](const std::string& text) { return count(flag, text); };
  };
  const auto any = [](const std::string& text) {
    return numberFor("--time", text, "a finite number of seconds", [](double) { return true; });
  };
  const auto rate = [](const std::string& text) { return positive("--fps", text); };
  for (const Status& s :
       {checkSequence(words), size(words.size, options.width, options.height),
        samples(words.samples, options.samples), choose("--view", words.view, kViews, options.shader.view),
        choose("--method", words.method, kMethods, options.shader.method), camera(words.camera, options.eye),
        take<int>(words.steps, options.maxSteps, whole("--steps")),
        take<double>(words.time, options.time, any),
        take<int>(words.frames, options.frames, whole("--frames")),
        take<double>(words.fps, options.framesPerSecond, rate),
        take<int>(words.bench, options.bench, whole("--bench"))})
    if (!s) return s.error();
  Result<std::map<std::string, double>> values = parameters(words.parameters);
  if (!values) return values.error();
  options.parameters = std::move(*values);
  return options;
}

}  // namespace

Result<std::variant<Options, Answer>> parseOptions(int argc, const char* const* argv) {
  using Parsed = std::variant<Options, Answer>;
  CLI::App app("Shows a scene of signed distances, in a window or as a picture.", "sdfview");
  app.set_version_flag("--version", std::string("sdfview ") + version());
  Words words;
  declare(app, words);
  Result<std::optional<Answer>> answer = parse(app, argc, argv);
  if (!answer) return answer.error();
  if (*answer) return Parsed(std::move(**answer));
  Result<Options> options = interpreted(words);
  if (!options) return options.error();
  return Parsed(std::move(*options));
}

}  // namespace sdf::viewer
