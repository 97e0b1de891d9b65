#include "options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <vector>

#include "memory.h"
#include "sdf/base/version.h"
#include "sdf/gltf/export.h"

namespace sdf {
namespace {

/// The command line's words, before they are looked at closer. All are text, so that messages are our own.
struct Words {
  std::string scene, output;
  std::optional<std::string> voxelSize, bounds, time, frames, fps, only, report, threads, maxMemory;
  std::vector<std::string> parameters;
  bool quiet = false;
};

Error usage(std::string message) { return {ErrorKind::Usage, std::move(message)}; }

/// The whole text as a finite number.
std::optional<double> number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// A flag's number; `wanted` says which numbers are right, in words and as a test.
template <class Test>
Result<double> numberFor(const char* flag, const std::string& text, const char* wanted, Test right) {
  const std::optional<double> value = number(text);
  if (value && right(*value)) return *value;
  return usage(std::string(flag) + " needs " + wanted + ", got '" + text + "'");
}

Result<double> positive(const char* flag, const std::string& text) {
  return numberFor(flag, text, "a number above 0", [](double v) { return v > 0.0; });
}

Result<double> count(const char* flag, const std::string& text) {
  constexpr double kMost = 100'000;
  return numberFor(flag, text, "a whole number from 1 to 100000",
                   [](double v) { return v >= 1.0 && v <= kMost && v == std::floor(v); });
}

Result<Box> box(const std::string& text) {
  std::vector<double> values;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) values.push_back(number(word).value_or(NAN));
  if (values.size() == 6 && text.back() != ',') {
    const Box bounds{{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
    const glm::dvec3 size = bounds.size();
    if (size.x > 0.0 && size.y > 0.0 && size.z > 0.0) return bounds;
  }
  return usage("--bounds needs six numbers x0,y0,z0,x1,y1,z1 with x0 < x1, y0 < y1 and z0 < z1, got '" +
               text + "'");
}

Result<std::map<std::string, double>> parameters(const std::vector<std::string>& words) {
  std::map<std::string, double> values;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::optional<double> value =
        equals == std::string::npos ? std::nullopt : number(word.substr(equals + 1));
    if (!value || equals == 0) return usage("-D needs name=value with a finite number, got '" + word + "'");
    if (!values.emplace(word.substr(0, equals), *value).second) {
      return usage("-D sets '" + word.substr(0, equals) + "' twice; keep one");
    }
  }
  return values;
}

/// Where the number goes in a file name: the place and length of its %d or %0Nd, if it has one.
struct NumberPlace {
  std::size_t begin, length;
  int digits;
};

std::optional<NumberPlace> numberPlace(const std::string& name, std::size_t from = 0) {
  const std::size_t begin = name.find('%', from);
  if (begin == std::string::npos) return std::nullopt;
  std::size_t end = begin + 1;
  int digits = 1;
  if (end + 1 < name.size() && name[end] == '0' && name[end + 1] >= '1' && name[end + 1] <= '9') {
    digits = name[end + 1] - '0';
    end += 2;
  }
  if (end < name.size() && name[end] == 'd') return NumberPlace{begin, end + 1 - begin, digits};
  return numberPlace(name, begin + 1);
}

Status checkSequence(const Words& words) {
  if (!words.frames) {
    if (words.fps) return usage("--fps says how fast --frames N go by; add --frames or leave --fps out");
    return okStatus();
  }
  const std::string name = std::filesystem::path(words.output).filename().string();
  const std::optional<NumberPlace> first = numberPlace(name);
  if (first && numberPlace(name, first->begin + first->length)) {
    return usage("'" + words.output + "' has more than one place for the frame's number; keep one %04d");
  }
  return okStatus();
}

void declare(CLI::App& app, Words& words) {
  app.add_option("SCENE", words.scene, "scene file (Lua)")->required()->type_name("");
  const auto add = [&](const char* flag, auto& word, const char* value, const char* what) {
    return app.add_option(flag, word, what)->type_name(value);
  };
  add("-o,--output", words.output, "OUT", "file to write: .glb .gltf .stl .ply .obj")->required();
  add("--voxel-size", words.voxelSize, "H", "sampling distance in scene units [1/200 of the longest side]");
  add("--bounds", words.bounds, "x0,y0,z0,x1,y1,z1", "clip to this box, closed [the scene's bounds]");
  add("-D", words.parameters, "name=value", "set a parameter of the scene; may be repeated")
      ->allow_extra_args(false);
  add("-t,--time", words.time, "T", "the scene's time in seconds [0]");
  add("--frames", words.frames, "N", "write N files, OUT_0001.glb and so on, or wherever OUT has %04d");
  add("--fps", words.fps, "F", "frames a second [24]");
  add("--only", words.only, "PART", "export this part alone");
  add("--report", words.report, "FILE.json", "write every figure to this file");
  add("--threads", words.threads, "N", "threads to use [all]");
  add("--max-memory", words.maxMemory, "GiB", "refuse to mesh what needs more [75 % of the machine's]");
  app.add_flag("-q,--quiet", words.quiet, "print errors only");
  app.footer(
      "Files appear under their names only when complete; of a sequence, finished frames stay if a later one "
      "fails.\n"
      "Exit status: 0 done, 2 usage, 3 scene, 4 limits, 5 files, 130 interrupted.");
}

/// What CLI11 found wrong, in one line.
std::string described(const CLI::ParseError& error) {
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    message = message.substr(0, message.find(':')) + " takes one value and can be given once";
  }
  return message + "; see sdf2gltf --help";
}

/// Fills `value` unless the flag was left out.
template <class T, class Target, class Parse>
Status take(const std::optional<std::string>& text, Target& value, Parse parse, double factor = 1.0) {
  if (!text) return okStatus();
  Result<double> parsed = parse(*text);
  if (!parsed) return parsed.error();
  value = static_cast<T>(*parsed * factor);
  return okStatus();
}

Result<Options> interpreted(const Words& words) {
  Options options;
  options.scene = words.scene;
  options.output = words.output;
  options.quiet = words.quiet;
  options.maxMemory = 0.75 * physicalMemory();
  options.only = words.only;
  options.report = words.report;

  if (Status s = checkExtension(words.output); !s) return s.error();
  if (Status s = checkSequence(words); !s) return s.error();
  const auto above0 = [](const char* flag) {
    return [flag](const std::string& text) { return positive(flag, text); };
  };
  const auto whole = [](const char* flag) {
    return [flag](const std::string& text) { return count(flag, text); };
  };
  const auto any = [](const std::string& text) {
    return numberFor("--time", text, "a finite number of seconds", [](double) { return true; });
  };
  constexpr double kGiB = 1024.0 * 1024.0 * 1024.0;
  if (Status s = take<double>(words.voxelSize, options.voxelSize, above0("--voxel-size")); !s)
    return s.error();
  if (Status s = take<double>(words.time, options.time, any); !s) return s.error();
  if (Status s = take<int>(words.frames, options.frames, whole("--frames")); !s) return s.error();
  if (Status s = take<double>(words.fps, options.framesPerSecond, above0("--fps")); !s) return s.error();
  if (Status s = take<int>(words.threads, options.threads, whole("--threads")); !s) return s.error();
  if (Status s = take<double>(words.maxMemory, options.maxMemory, above0("--max-memory"), kGiB); !s)
    return s.error();
  if (words.bounds) {
    Result<Box> bounds = box(*words.bounds);
    if (!bounds) return bounds.error();
    options.bounds = *bounds;
  }
  Result<std::map<std::string, double>> values = parameters(words.parameters);
  if (!values) return values.error();
  options.parameters = std::move(*values);
  return options;
}

}  // namespace

Result<std::variant<Options, Answer>> parseOptions(int argc, const char* const* argv) {
  using Parsed = std::variant<Options, Answer>;
  CLI::App app("Meshes a scene of signed distances and writes it as glTF, STL, PLY or OBJ.", "sdf2gltf");
  app.set_version_flag("--version", std::string("sdf2gltf ") + version());
  Words words;
  declare(app, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return Parsed(Answer{app.help()});
  } catch (const CLI::CallForVersion&) {
    return Parsed(Answer{app.version() + "\n"});
  } catch (const CLI::ParseError& error) {
    return usage(described(error));
  }
  Result<Options> options = interpreted(words);
  if (!options) return options.error();
  return Parsed(std::move(*options));
}

std::filesystem::path frameName(const std::filesystem::path& output, int number) {
  const std::string name = output.filename().string(), digits = std::to_string(number);
  const auto padded = [&](int width) {
    const auto missing = std::max<std::ptrdiff_t>(0, width - static_cast<std::ptrdiff_t>(digits.size()));
    return std::string(static_cast<std::size_t>(missing), '0') + digits;
  };
  const std::optional<NumberPlace> place = numberPlace(name);
  std::filesystem::path numbered = output;
  if (place) {
    numbered.replace_filename(std::string(name).replace(place->begin, place->length, padded(place->digits)));
  } else {
    numbered.replace_filename(output.stem().string() + "_" + padded(4) + output.extension().string());
  }
  return numbered;
}

}  // namespace sdf
