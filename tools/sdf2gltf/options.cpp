#include "options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <vector>

#include "command_line/frames.h"
#include "command_line/values.h"
#include "memory.h"
#include "sdf/base/file.h"
#include "sdf/base/version.h"
#include "sdf/export/export.h"

namespace sdf::exporter {

using namespace command_line;  // NOLINT: this file is about nothing else

namespace {

/// The command line's words, before they are looked at closer. All are text, so that messages are our own.
struct Words {
  std::vector<std::filesystem::path> folders;
  std::string scene, output;
  std::optional<std::string> voxelSize, tolerance, triangles, levels, bounds, time, frames, fps, only, report,
      threads, maxMemory;
  std::vector<std::string> parameters;
  bool animate = false, bake = false, compress = false, certify = false, keepGoing = false, quiet = false;
};

Status box(const std::optional<std::string>& text, std::optional<Box>& bounds) {
  if (!text) return okStatus();
  const std::vector<double> v = numbers(*text);
  if (v.size() == 6 && v[0] < v[3] && v[1] < v[4] && v[2] < v[5]) {
    bounds = Box{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    return okStatus();
  }
  return usage("--bounds needs six numbers x0,y0,z0,x1,y1,z1 with x0 < x1, y0 < y1 and z0 < z1, got '" +
               *text + "'");
}

Status tolerance(const Words& words, Options& options) {
  const std::optional<std::string>& text = words.tolerance;
  if (!text) {
    options.strict = words.triangles.has_value();
    if (!words.voxelSize) options.tolerance = kDefaultTolerance, options.toleranceOfDiagonal = true;
    return okStatus();
  }
  std::string number = *text;
  options.toleranceOfDiagonal = number.ends_with('%');
  if (options.toleranceOfDiagonal) number.pop_back();
  const Result<double> value = positive("--tolerance", number);
  if (!value)
    return usage(
        "--tolerance needs a number above 0, of scene units or with % of the diagonal of all that is "
        "exported, "
        "got '" +
        *text + "'");
  options.tolerance = options.toleranceOfDiagonal ? 0.01 * *value : *value;
  return okStatus();
}

// Precondition: checkExtension(words.output).
Status checkSequence(const Words& words) {
  if (words.animate && !words.frames)
    return usage("--animate puts frames into one file; say how many with --frames N, or leave --animate out");
  if (words.animate && !isGltf(words.output))
    return usage(
        "--animate: " + lowerExtension(words.output) +
        " files hold no animation; write .glb or .gltf, or leave --animate out for a file for each frame");
  if (words.animate) return okStatus();
  if (words.frames) return checkFrameName(words.output);
  if (words.fps) return usage("--fps says how fast --frames N go by; add --frames or leave --fps out");
  return okStatus();
}

Status checkDetail(const Words& words) {
  if (words.keepGoing && !words.tolerance)
    return usage(
        "--keep-going is for a --tolerance that may not be kept; the tolerance of its own is kept where it "
        "can be anyway: say --tolerance, or leave --keep-going out");
  if (words.triangles && words.tolerance)
    return usage("--triangles finds the tolerance that so many triangles keep; leave --tolerance out");
  if (words.triangles && words.animate)
    return usage("--triangles counts those of one moment; with --animate, say --tolerance");
  if (words.levels && words.voxelSize && !words.tolerance)
    return usage(
        "--lod takes four times the tolerance for each level, and with --voxel-size there is none; say "
        "--tolerance of the first, or leave --voxel-size out");
  if (words.levels && words.animate) return usage("--lod: leave --animate out, or call it for each level");
  return okStatus();
}

// Precondition: checkExtension(words.output).
Status checkBake(const Words& words) {
  if (!words.bake || isGltf(words.output)) return okStatus();
  return usage("--bake writes ambient light as the emission of materials, which " +
               lowerExtension(words.output) + " files do not have; write .glb or .gltf, or leave --bake out");
}

// Precondition: checkExtension(words.output).
Status checkCompress(const Words& words) {
  if (!words.compress || isGltf(words.output)) return okStatus();
  return usage("--compress: " + lowerExtension(words.output) +
               " files cannot be compressed; write .glb or .gltf, or leave --compress out");
}

void declare(CLI::App& app, Words& words) {
  app.add_option("SCENE", words.scene, "scene file (Lua)")->required()->type_name("");
  const auto add = [&](const char* flag, auto& word, const char* value, const char* what) {
    return app.add_option(flag, word, what)->type_name(value);
  };
  add("-o,--output", words.output, "OUT", "file to write: .glb .gltf .stl .ply .obj")->required();
  add("--tolerance", words.tolerance, "E",
      "distance from the surface that meshes keep with few triangles, in scene units or, as E%, in "
      "hundredths of the diagonal of all that is exported [0.05%, where it can be kept]");
  app.add_flag("--keep-going", words.keepGoing,
               "write the file, with a warning, where --tolerance cannot be kept everywhere");
  add("--voxel-size", words.voxelSize, "H",
      "sampling distance in scene units [1/200 of the longest side of all that is exported]; without "
      "--tolerance, triangles are as large everywhere");
  add("--triangles", words.triangles, "N", "the smallest tolerance that so many triangles keep");
  add("--lod", words.levels, "N",
      "write N levels of detail, OUT and OUT_lod1 on, each with 4 times the tolerance");
  add("--bounds", words.bounds, "x0,y0,z0,x1,y1,z1", "clip to this box, closed [the scene's bounds]");
  add("-D", words.parameters, "name=value", "set a parameter of the scene; may be repeated")
      ->allow_extra_args(false);
  add("-t,--time", words.time, "T", "the scene's time in seconds [0]");
  add("--frames", words.frames, "N", "write N files, OUT_0001.glb and so on, or wherever OUT has %04d");
  add("--allow-dir", words.folders, "DIR", "a folder, beside the scene's own, from which it may read meshes")
      ->allow_extra_args(false);
  app.add_flag("--animate", words.animate, "write the frames as one .glb or .gltf that moves");
  add("--fps", words.fps, "F", "frames a second [24]");
  add("--only", words.only, "PART", "export this part alone");
  add("--report", words.report, "FILE.json", "write every figure to this file");
  add("--threads", words.threads, "N", "threads to use [all]");
  add("--max-memory", words.maxMemory, "GiB", "refuse to mesh what needs more [75 % of the machine's]");
  app.add_flag("--bake", words.bake,
               "put the ambient light and its occlusion into .glb and .gltf files, as emission");
  app.add_flag("--compress", words.compress,
               "write smaller .glb and .gltf files, for readers that know EXT_meshopt_compression");
  app.add_flag("--certify", words.certify,
               "prove how far mesh and surface are from each other at most, both ways");
  app.add_flag("-q,--quiet", words.quiet, "print errors only");
  app.footer(
      "Files appear under their names only when complete; of a sequence, finished frames stay if a later one "
      "fails.\n"
      "Exit status: 0 done, 2 usage, 3 scene, 4 limits, 5 files, 130 interrupted.");
}

Result<Options> interpreted(const Words& words) {
  Options options;
  options.folders = words.folders;
  options.scene = words.scene;
  options.output = words.output;
  options.animate = words.animate;
  options.bake = words.bake;
  options.compress = words.compress;
  options.certify = words.certify;
  options.keepGoing = words.keepGoing;
  options.quiet = words.quiet;
  options.maxMemory = 0.75 * physicalMemory();
  options.only = words.only;
  options.report = words.report;

  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  if (Status s = checkExtension(words.output); !s) return s.error();
  for (const Status& s :
       {checkBake(words), checkCompress(words), checkSequence(words), checkDetail(words),
        take<double>("--voxel-size", words.voxelSize, options.voxelSize, positive), tolerance(words, options),
        take<int>("--triangles", words.triangles, options.triangles, largeCount),
        take<int>("--lod", words.levels, options.levels, smallCount),
        take<double>("--time", words.time, options.time, seconds),
        take<int>("--frames", words.frames, options.frames, count),
        take<double>("--fps", words.fps, options.framesPerSecond, positive),
        take<int>("--threads", words.threads, options.threads, count),
        take<double>("--max-memory", words.maxMemory, options.maxMemory, positive, kGiB),
        box(words.bounds, options.bounds)})
    if (!s) return s.error();
  Result<std::map<std::string, double>> values = parameters(words.parameters);
  if (!values) return values.error();
  options.parameters = std::move(*values);
  return options;
}

}  // namespace

double frameTime(const Options& options, int i) { return options.time + i / options.framesPerSecond; }

double levelTolerance(const Options& options, int level) {
  constexpr double kBetweenLevels = 4.0;  // and as many triangles
  return options.tolerance * std::pow(kBetweenLevels, level);
}

std::filesystem::path levelName(const std::filesystem::path& output, int level) {
  if (level == 0) return output;
  std::filesystem::path name = output;
  return name.replace_filename(output.stem().string() + "_lod" + std::to_string(level) +
                               output.extension().string());
}

int filesOf(const Options& options) { return options.animate ? 1 : options.frames.value_or(1); }

std::filesystem::path targetOf(const Options& options, int i) {
  return options.frames && !options.animate ? frameName(options.output, i + 1) : options.output;
}

std::vector<std::filesystem::path> targetsOf(const Options& options) {
  std::vector<std::filesystem::path> all;
  for (int i = 0; i < filesOf(options); ++i)
    for (int level = 0; level < options.levels.value_or(1); ++level)
      all.push_back(levelName(targetOf(options, i), level));
  if (options.report) all.push_back(*options.report);
  return all;
}

std::string frameSubject(const Options& options, int i) {
  return options.frames ? "frame " + std::to_string(i + 1) + " of " + std::to_string(*options.frames) : "";
}

Result<std::variant<Options, Answer>> parseOptions(int argc, const char* const* argv) {
  using Parsed = std::variant<Options, Answer>;
  CLI::App app("Meshes a scene of signed distances and writes it as glTF, STL, PLY or OBJ.", "sdf2gltf");
  app.set_version_flag("--version", std::string("sdf2gltf ") + version());
  Words words;
  declare(app, words);
  Result<std::optional<Answer>> answer = parse(app, argc, argv);
  if (!answer) return answer.error();
  if (*answer) return Parsed(std::move(**answer));
  Result<Options> options = interpreted(words);
  if (!options) return options.error();
  return Parsed(std::move(*options));
}

}  // namespace sdf::exporter
