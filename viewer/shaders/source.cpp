#include "viewer/shaders/source.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "viewer/shaders/light_parts.h"
#include "viewer/shaders/ray_parts.h"
#include "viewer/shaders/triangle_parts.h"
#include "viewer/shaders/view_parts.h"

namespace sdf::viewer {
namespace {

std::string nameOf(const std::string& macro) { return macro.substr(0, macro.find('(')); }

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool isCapitals(std::string_view word) {
  return word.size() > 1 && std::isupper(static_cast<unsigned char>(word.front())) != 0 &&
         std::none_of(word.begin(), word.end(), [](unsigned char c) { return std::islower(c) != 0; });
}

std::string withoutComments(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t comment = std::min(text.find("//"), text.size());
    result += text.substr(0, comment);
    text.remove_prefix(std::min(text.find('\n', comment), text.size()));
  }
  return result;
}

/// The words of a text in order, operators and blanks left out.
std::vector<std::string_view> wordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && isWord(text[end])) ++end;
    if (end > i) words.push_back(text.substr(i, end - i));
    i = std::max(end, i + 1);
  }
  return words;
}

/// The constants that the text declares: the capitals between a `const` and the end of its statement.
std::set<std::string> constantsOf(const std::string& text) {
  std::set<std::string> result;
  for (std::size_t i = text.find("const "); i < text.size(); i = text.find("const ", i + 1))
    for (const auto word : wordsOf(std::string_view(text).substr(i, text.find(';', i) - i)))
      if (isCapitals(word)) result.emplace(word);
  return result;
}

/// The line with the version, and the precision where it must be stated.
std::string header(bool es) {
  return es ? "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp "
              "sampler2D;\nprecision highp sampler3D;\n"
            : "#version 330 core\n";
}

}  // namespace

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", v);
  return std::string("float(") + text + ")";
}

std::string number(double v, GlslWriter& writer) { return "float(" + writer.changingTerm(v) + ")"; }

std::string vector(const glm::dvec3& v, GlslWriter& writer) {
  const std::string x = number(v.x, writer), y = number(v.y, writer), z = number(v.z, writer);
  return "vec3(" + x + ", " + y + ", " + z + ")";
}

std::set<std::string> usedMacros(std::string_view source) {
  const std::string text = withoutComments(source);
  const std::set<std::string> constants = constantsOf(text);
  std::set<std::string> result;
  for (const auto word : wordsOf(text))
    if (isCapitals(word) && !constants.contains(std::string(word))) result.emplace(word);
  return result;
}

std::vector<std::string> deadMacros(const Macros& macros) {
  using namespace parts;
  // clang-format off
  static constexpr const char* kParts[] = {
      kCamera, kHit, kField, kRest, kRestByBox, kPlanes, kNoPlanes, kBalls, kMarch, kNoMarch, kGradient, kGradientByTaps, kNormal, kMeet,
      kRayStarts, kHitCounts, kPictureCounts, kCones, kFavoured, kHits, kMarks, kTriangles, kTakeLook, kHitFromLayers, kFootprint, kShadowSpan,
      kNoShadowSpan, kPlanesLight, kNoPlanesLight, kBallsLight, kNoBallsLight, kShadowSettings, kVisible, kHardShadow, kSoftShadow,
      kImprovedShadow, kSignedShadow, kArriving, kArrivingSized, kBayer, kChosen, kOcclusionTaps,
      kOcclusionSteps, kLightAround, kLightSettings, kLights, kGlossy, kLens, kRadiance,
      kBackground, kSliceView, kHitColor, kHitsView, kNormalsView, kStepsView, kGradientView,
      kMaterialView, kOcclusionView, kShadowView, kErrorView, kTakeMeshLook, kEdged, kNothing, kSrgb, kFilmic, kDither, kPicture, kResolve};
  // clang-format on
  std::set<std::string> used;
  for (const char* const part : kParts) used.merge(usedMacros(part));
  for (const auto& [macro, value] : macros) used.merge(usedMacros(value));
  std::vector<std::string> dead;
  for (const auto& [macro, value] : macros)
    if (!used.contains(nameOf(macro))) dead.push_back(nameOf(macro));
  return dead;
}

std::vector<std::string> macroFaults(std::string_view shader) {
  constexpr std::string_view kDefine = "#define ";
  std::istringstream lines(withoutComments(shader));
  std::string rest;  // without the names that are being defined
  std::set<std::string> defined;
  for (std::string line; std::getline(lines, line); rest += line + '\n')
    if (line.starts_with(kDefine)) {
      const std::string name(wordsOf(line)[1]);
      line.erase(0, kDefine.size() + name.size());
      defined.insert(name);
    }
  const std::set<std::string> used = usedMacros(rest);
  std::vector<std::string> faults;
  for (const std::string& name : used)
    if (!defined.contains(name)) faults.push_back(name + " is used but not defined");
  for (const std::string& name : defined)
    if (!used.contains(name)) faults.push_back(name + " is defined but not used");
  return faults;
}

#ifdef NDEBUG
bool Composer::strict = false;
#else
bool Composer::strict = true;
#endif

Composer::Composer(bool es, Macros macros, Functions functions, GlslWriter writer, std::string globals)
    : start_(header(es) + globals),
      macros_(std::move(macros)),
      functions_(std::move(functions)),
      writer_(std::move(writer)) {
  if (!strict) return;
  if (const auto dead = deadMacros(macros_); !dead.empty())
    throw std::logic_error(dead.front() + " is used by no part");
}

std::string Composer::compose(const std::string& body) {
  std::string definitions, open = body, all = body;
  std::set<std::string> defined;
  while (!open.empty()) {
    const std::set<std::string> used = usedMacros(open);
    open.clear();
    for (const auto& [macro, value] : macros_)
      if (used.contains(nameOf(macro)) && defined.insert(macro).second) {
        definitions += "#define " + macro + " " + value + "\n";
        open += value + "\n";
      }
    all += open;
  }
  const std::string code = withoutComments(all);
  for (const auto word : wordsOf(code))
    if (const auto function = functions_.find(std::string(word));
        function != functions_.end() && written_.insert(function->first).second)
      writer_.add(function->first, function->second());
  const std::string functions = writer_.source();
  std::string shader = start_ + definitions + functions + body;
  if (functions.find("double ") != std::string::npos)
    shader.insert(shader.find('\n') + 1, "#extension GL_ARB_gpu_shader_fp64 : require\n");
  if (!strict) return shader;
  if (const auto faults = macroFaults(shader); !faults.empty()) throw std::logic_error(faults.front());
  return shader;
}

}  // namespace sdf::viewer
