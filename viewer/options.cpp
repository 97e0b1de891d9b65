#include "viewer/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <span>

#include "command_line/frames.h"
#include "sdf/base/version.h"
#include "sdf/meshfile/read_mesh.h"
#include "viewer/gpu/picture.h"

namespace sdf::viewer {

using namespace command_line;  // NOLINT: this file is about nothing else

namespace {

constexpr auto kFirstOfMesh = static_cast<std::size_t>(View::Mesh);
constexpr std::span kMarchedViews = std::span(kViews).first<kFirstOfMesh>();
constexpr std::span kMeshViews = std::span(kViews).subspan<kFirstOfMesh>();

// "a, b or c", each with its note if these are wanted.
std::string listOf(const auto& some, bool withNotes = false, const char* last = " or ") {
  const std::span choices(some);
  std::string list;
  for (const auto& one : choices) {
    list += (&one == &choices.front() ? "" : &one == &choices.back() ? last : ", ") + std::string(one.word);
    if (withNotes && *one.note) list += " (" + std::string(one.note) + ")";
  }
  return list;
}

template <class Enum, std::size_t n>
Status choose(const char* flag, const std::string& word, const Choice<Enum> (&choices)[n], Enum& value) {
  const auto found = std::ranges::find(choices, word, &Choice<Enum>::word);
  if (found == std::end(choices))
    return usage(std::string(flag) + " needs " + listOf(choices) + ", got '" + word + "'");
  value = found->value;
  return okStatus();
}

Status size(const std::string& word, Options& options) {
  const std::size_t cross = word.find('x');
  const auto side = [](const std::optional<double>& v) {
    return v && *v >= 1.0 && *v <= 65536.0 && *v == std::floor(*v);
  };
  const auto w = number(word.substr(0, cross));
  const auto h = cross == std::string::npos ? std::nullopt : number(word.substr(cross + 1));
  if (!side(w) || !side(h))
    return usage("--size needs WIDTHxHEIGHT in whole pixels from 1, got '" + word + "'");
  options.width = static_cast<int>(*w);
  options.height = static_cast<int>(*h);
  return okStatus();
}

Status samples(const std::string& word, int& side) {
  const auto n = number(word);
  const double root = n ? std::sqrt(*n) : 0.0;
  if (!(root >= 1.0 && root <= 32.0 && root == std::floor(root)))
    return usage("--samples needs a square from 1 to 1024 (1, 4, 9, ...), got '" + word + "'");
  side = static_cast<int>(root);
  return okStatus();
}

Status camera(const std::string& word, std::optional<Eye>& eye) {
  const std::vector<double> v = numbers(word);
  const auto wrong = [&](const std::string& needs) {
    return usage("--camera needs " + needs + ", got '" + word + "'");
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

Status tolerance(const std::string& word, MeshSettings& mesh) {
  std::string number = word;
  mesh.toleranceOfDiagonal = number.ends_with('%');
  if (mesh.toleranceOfDiagonal) number.pop_back();
  const auto value = positive("--tolerance", number);
  if (!value)
    return usage(
        "--tolerance needs a number above 0, of scene units or with % of the diagonal of all that is meshed, "
        "got '" +
        word + "'");
  mesh.tolerance = mesh.toleranceOfDiagonal ? 0.01 * *value : *value;
  return okStatus();
}

Status split(const std::string& word, double& share) {
  const auto value = number(word);
  if (!(value && *value > 0.0 && *value < 1.0))
    return usage("--split needs a share of the width between 0 and 1, got '" + word + "'");
  share = *value;
  return okStatus();
}

// What says how meshes are shown needs a view that shows one.
Status checkMesh(const Options& options, bool hasSplit) {
  const View view = options.shader.view;
  const std::string named = std::string("--view ") + kViews[static_cast<int>(view)].word;
  const bool windowed = !options.picture && !options.bench && !options.glsl;
  const char* const flag = options.mesh.tolerance   ? "--tolerance"
                           : options.mesh.voxelSize ? "--voxel-size"
                           : options.meshFile       ? "--mesh"
                                                    : nullptr;
  if (flag && !windowed && !showsMesh(view))
    return usage(std::string(flag) + " is about a mesh, which " + named + " does not show; add --view " +
                 listOf(kMeshViews) + ", or leave " + flag + " out");
  if (hasSplit && view != View::Split && !windowed)
    return usage("--split says where --view split is divided; add that, or leave --split out");
  if (options.meshFile && options.mesh.voxelSize)
    return usage("--voxel-size is of the scene's own mesh, and --mesh shows a file's; leave one of them out");
  if (options.meshFile && options.mesh.toleranceOfDiagonal)
    return usage(
        "--tolerance with % is of the scene's own mesh, and --mesh shows a file's; say it in scene units");
  if (options.meshFile && options.mesh.tolerance && view != View::Error && !windowed)
    return usage(
        "--tolerance beside --mesh says what --view error compares the file with; add that, or leave "
        "--tolerance out");
  if (options.glsl && showsMesh(view))
    return usage("--glsl writes a shader that marches the scene, which " + named +
                 " does not; leave one of them out");
  if (options.meshFile) return checkReadable(*options.meshFile);
  return okStatus();
}

Status checkSequence(const Options& options, bool hasRate) {
  if (options.frames) {
    if (!options.picture)
      return usage("--frames says how many pictures --render OUT.png draws; add --render");
    return checkFrameName(*options.picture);
  }
  if (hasRate) return usage("--fps says how fast --frames N go by; add --frames or leave --fps out");
  return okStatus();
}

Result<Comparison> comparison(const std::string& word) {
  Comparison result{.name = word};
  if (word == "no-culling") {
    result.culling = false;
    return result;
  }
  if (Start start{}; choose("--compare", word, kStarts, start)) {
    result.start = start;
    return result;
  }
  auto value = parameters({word});
  if (!value)
    return usage("--compare needs no-culling, " + listOf(kStarts, false, ", ") + " or name=value, got '" +
                 word + "'");
  result.parameters = std::move(*value);
  return result;
}

Status compare(const std::vector<std::string>& words, Options& options) {
  if (!words.empty() && !options.bench)
    return usage("--compare says what --bench N is beside; add --bench or leave --compare out");
  for (const std::string& word : words) {
    auto one = comparison(word);
    if (!one) return one.error();
    options.comparisons.push_back(std::move(*one));
  }
  return okStatus();
}

/// Words are what is taken as a whole once all options are known.
struct Words {
  std::vector<std::string> parameters, comparisons;
};

/// Declares what fills the options; `sound` tells the first word that is wrong.
void declare(CLI::App& app, Options& options, Words& words, Status& sound) {
  const auto add = [&](const char* flag, const char* value, const std::string& what, auto read) {
    const auto readIfSound = [&sound, read](const std::string& word) {
      if (sound) sound = read(word);
    };
    app.add_option_function<std::string>(flag, readIfSound, what)->type_name(value);
  };
  const auto whole = [&](const char* flag, auto& place, const char* what) {
    add(flag, "N", what,
        [flag, &place](const std::string& word) { return take<int>(flag, word, place, count); });
  };
  const auto measure = [&](const char* flag, const char* value, auto& place, const char* what) {
    add(flag, value, what,
        [flag, &place](const std::string& word) { return take<double>(flag, word, place, positive); });
  };
  const auto repeated = [&](const char* flag, const char* value, auto& places, const char* what) {
    app.add_option(flag, places, what)->type_name(value)->allow_extra_args(false);
  };
  const auto choice = [&](const char* flag, const auto& choices, auto& place, const std::string& what) {
    add(flag, "NAME", what,
        [flag, &choices, &place](const std::string& word) { return choose(flag, word, choices, place); });
  };
  app.add_option("SCENE", options.scene.path, "scene file (Lua)")->required()->type_name("");
  app.add_option("-o,--render", options.picture, "draw into this file, without a window")
      ->type_name("OUT.png");
  add("--size", "WxH", "of the picture in pixels [1280x720]",
      [&](const std::string& word) { return size(word, options); });
  add("-t,--time", "T", "the scene's time in seconds [0]",
      [&](const std::string& word) { return take<double>("--time", word, options.time, seconds); });
  add("--samples", "N", "samples a pixel: 1, 4, 9, ... [1]",
      [&](const std::string& word) { return samples(word, options.samples); });
  measure("--seconds", "S", options.seconds,
          "refine for S seconds, or until more samples are not seen to help");
  whole("--steps", options.maxSteps, "readings of the distance that a ray may take [1024]");
  choice("--view", kViews, options.shader.view,
         listOf(kMarchedViews, false, ", ") +
             "; or with a mesh, as sdf2gltf exports it: " + listOf(kMeshViews, true));
  add("--tolerance", "E",
      "distance from the surface that the mesh keeps, in scene units or, as E%, in hundredths of the "
      "diagonal [0.05%, where it can be kept]",
      [&](const std::string& word) { return tolerance(word, options.mesh); });
  measure("--voxel-size", "H", options.mesh.voxelSize,
          "sampling distance of the mesh; without --tolerance, triangles are as large everywhere");
  app.add_option("--mesh", options.meshFile, "show this mesh (.glb .gltf .stl .ply .obj) against the scene")
      ->type_name("FILE");
  add("--split", "S", "share of the width at which --view split begins to show the mesh [0.5]",
      [&](const std::string& word) { return split(word, options.split); });
  choice("--method", kMethods, options.shader.method, "how rays are marched: " + listOf(kMethods, true));
  choice("--start", kStarts, options.shader.start,
         "where rays of --method auto start: " + listOf(kStarts, true));
  repeated("-D", "name=value", words.parameters, "set a parameter of the scene; may be repeated");
  repeated("--allow-dir", "DIR", options.scene.folders,
           "a folder, beside the scene's own, from which it may read meshes");
  app.add_flag("!--no-cache", options.scene.cached,
               "sample meshes anew, and keep nothing of it in the user's cache folder");
  add("--camera", "x,y,z,x,y,z[,fov]", "where the camera stands and looks, and its field of view",
      [&](const std::string& word) { return camera(word, options.eye); });
  app.add_flag("-q,--quiet", options.quiet, "do not say how far --render and --bench are");
  app.add_flag("--fit", options.fit,
               "move the camera to where all of the scene is in view; its direction stays");
  app.add_flag("!--no-culling", options.shader.culling,
               "read all parts of a scene everywhere, not those alone that are near: to compare with");
  whole("--frames", options.frames, "draw N pictures, OUT_0001.png and so on, or wherever OUT has %04d");
  measure("--fps", "F", options.framesPerSecond, "frames a second [24]");
  whole("--bench", options.bench, "draw N frames and print as JSON what they cost");
  repeated("--compare", "WAY", words.comparisons,
           "beside --bench, time another way to draw it by turns: no-culling, a --start, or name=value for "
           "another parameter; may be repeated");
  app.add_option("--glsl", options.glsl, "write the shader that draws the scene")->type_name("OUT.glsl");
  app.footer(
      "Without --render, --bench and --glsl a window opens.\n"
      "Exit status: 0 done, 2 usage, 3 scene, 4 limits, 5 files, 6 graphics, 130 interrupted.");
}

}  // namespace

Result<std::variant<Options, Answer>> parseOptions(int argc, const char* const* argv) {
  using Parsed = std::variant<Options, Answer>;
  CLI::App app("Shows a scene of signed distances, in a window or as a picture.", "sdfview");
  app.set_version_flag("--version", std::string("sdfview ") + version());
  Options options;
  Words words;
  Status sound = okStatus();
  declare(app, options, words, sound);
  Result<std::optional<Answer>> answer = parse(app, argc, argv);
  if (!answer) return answer.error();
  if (*answer) return Parsed(std::move(**answer));
  if (sound && options.picture) sound = checkPictureName(*options.picture);
  if (sound && options.seconds && !options.picture)
    sound = usage("--seconds says how long --render OUT.png refines; add --render or leave --seconds out");
  if (sound) sound = compare(words.comparisons, options);
  if (sound) sound = checkSequence(options, app.count("--fps") > 0);
  if (sound) sound = checkMesh(options, app.count("--split") > 0);
  if (!sound) return sound.error();
  if (auto s = keep(parameters(words.parameters), options.parameters); !s) return s.error();
  return Parsed(std::move(options));
}

}  // namespace sdf::viewer
