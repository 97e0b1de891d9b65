#include "viewer/gpu/program.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/gtc/type_ptr.hpp>
#include <regex>
#include <stdexcept>

#include "viewer/gpu/context.h"

namespace sdf::viewer {
namespace {

constexpr const char* kOverScreen = R"(#version 330 core
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

// A point is a square: one corner to transform and one shape to set up.
constexpr const char* kOverTiles = R"(#version 330 core
uniform sampler2D tiles;  // values of all tiles, in one cell or in rows of them
uniform vec2 tileGrid;    // columns and rows of a cell
uniform float tileSide;   // pixels
uniform float tileLimit;
uniform int firstCell, lastCell;

// Column and row of the i-th of all; in floats, which are exact up to 2^24 and faster than dividing integers.
vec2 split(float i, float columns) {
  float row = floor((i + 0.5) / columns);
  return vec2(i - row * columns, row);
}

void main() {
  vec2 tile = split(float(gl_VertexID), tileGrid.x);
  float across = floor(float(textureSize(tiles, 0).x) / tileGrid.x);
  bool drawn = false;
  for (int cell = firstCell; cell <= lastCell; ++cell)
    drawn = drawn || texelFetch(tiles, ivec2(split(float(cell), across) * tileGrid + tile), 0).r < tileLimit;
  gl_PointSize = tileSide;
  gl_Position = drawn ? vec4((2.0 * tile + 1.0) / tileGrid - 1.0, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
)";

/// What OpenGL says of an object by this pair of functions.
template <class GetNumber, class GetText>
std::string textOf(GLuint object, GLenum length, GetNumber getNumber, GetText getText) {
  GLint size = 0;
  getNumber(object, length, &size);
  std::string text(std::size_t(size), '\0');
  getText(object, size, nullptr, text.data());
  return text;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks(" \t\r\n\0", 5);  // a log ends with a zero
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> lines(std::string_view text) {
  std::vector<std::string_view> found;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    found.push_back(trimmed(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return found;
}

/// A line of a log: "line N: WORDS in 'THAT LINE'" as far as it names a place; empty for a warning.
std::string complaint(const std::string& text, const std::vector<std::string_view>& source) {
  constexpr std::size_t kLongestQuote = 200;  // generated lines can be very long
  for (const char* const place : {"%*d:%d(%*d): %n", "%*d(%d) : %n", "ERROR: %*d:%d: %n"}) {
    int line = 0, length = -1;
    if (std::sscanf(text.c_str(), place, &line, &length) != 1 || length < 0) continue;
    const std::string words = text.substr(std::size_t(length));
    if (words.starts_with("warning")) return "";
    const bool known = line >= 1 && std::size_t(line) <= source.size();
    const auto quoted = known ? source[std::size_t(line) - 1].substr(0, kLongestQuote) : std::string_view();
    return (line > 0 ? "line " + std::to_string(line) + ": " : "") + words +
           (quoted.empty() ? "" : " in '" + std::string(quoted) + "'");
  }
  return text.starts_with("warning") ? "" : text;
}

Error rejected(const std::string& what, const std::string& log, const std::string& source) {
  const std::string words = complaintsOf(log, source);
  return {ErrorKind::Graphics,
          "the driver rejects the " + what + ": " + (words.empty() ? "it does not say why" : words)};
}

Result<Handle> compile(GLenum kind, const char* name, const std::string& source) {
  Handle shader(glCreateShader(kind), [](unsigned id) { glDeleteShader(id); });
  const char* const text = source.c_str();
  glShaderSource(shader.id(), 1, &text, nullptr);
  glCompileShader(shader.id());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE)
    return rejected(name, textOf(shader.id(), GL_INFO_LOG_LENGTH, glGetShaderiv, glGetShaderInfoLog), source);
  return shader;
}

}  // namespace

std::string complaintsOf(std::string_view log, std::string_view source) {
  constexpr std::size_t kMost = 3;  // what follows the first is seldom news
  const auto sourceLines = lines(source);
  std::string all;
  std::size_t count = 0;
  for (const std::string_view line : lines(log)) {
    const std::string words = complaint(std::string(line), sourceLines);
    if (!words.empty() && ++count <= kMost) all += (count > 1 ? "; " : "") + words;
  }
  return count > kMost ? all + "; and " + std::to_string(count - kMost) + " more" : all;
}

std::set<std::string> declaredUniforms(const std::string& source) {
  static const std::regex declaration("(?:^|[;\\n])\\s*uniform\\s+\\w+\\s([^;]*)"), name("(\\w+)[^,]*");
  std::set<std::string> names;
  for (std::sregex_iterator list(source.begin(), source.end(), declaration), end; list != end; ++list) {
    const std::string declarators = (*list)[1];
    for (std::sregex_iterator one(declarators.begin(), declarators.end(), name); one != end; ++one)
      names.insert((*one)[1]);
  }
  return names;
}

#ifdef NDEBUG
bool Program::strict = false;
#else
bool Program::strict = true;
#endif

Result<Program> Program::create(const std::string& vertex, const std::string& fragment) {
  const auto vertexShader = compile(GL_VERTEX_SHADER, "vertex shader", vertex);
  if (!vertexShader) return vertexShader.error();
  const auto fragmentShader = compile(GL_FRAGMENT_SHADER, "fragment shader", fragment);
  if (!fragmentShader) return fragmentShader.error();

  Handle program(glCreateProgram(), [](unsigned id) { glDeleteProgram(id); });
  for (const auto* const shader : {&vertexShader, &fragmentShader})
    glAttachShader(program.id(), (*shader)->id());
  glLinkProgram(program.id());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE)
    return rejected("linked shaders",
                    textOf(program.id(), GL_INFO_LOG_LENGTH, glGetProgramiv, glGetProgramInfoLog), fragment);

  // A core context draws nothing without one, though it holds nothing here.
  Handle vertexArray(glGenVertexArrays, [](unsigned id) { glDeleteVertexArrays(1, &id); });
  if (const Status made = check("make a shader program"); !made) return made.error();
  return Program(std::move(program), std::move(vertexArray));
}

Result<Program> Program::overScreen(const std::string& fragment) { return create(kOverScreen, fragment); }

Result<Program> Program::overTiles(const std::string& fragment) { return create(kOverTiles, fragment); }

int Program::location(const std::string& name) const {
  glUseProgram(program_.id());
  const auto [found, isNew] = locations_.try_emplace(name, -1);
  if (isNew) found->second = glGetUniformLocation(program_.id(), name.c_str());
  return found->second;
}

const std::set<std::string>& Program::declared() const {
  if (declared_) return *declared_;
  std::array<GLuint, 2> shaders{};
  GLsizei count = 0;
  glGetAttachedShaders(program_.id(), GLsizei(shaders.size()), &count, shaders.data());
  declared_.emplace();
  for (GLsizei i = 0; i < count; ++i)
    declared_->merge(declaredUniforms(
        textOf(shaders[std::size_t(i)], GL_SHADER_SOURCE_LENGTH, glGetShaderiv, glGetShaderSource)));
  return *declared_;
}

std::vector<std::string> Program::uniformFaults() const {
  std::vector<std::string> faults;
  for (const auto& [name, place] : locations_)
    if (!declared().contains(name)) faults.push_back("the uniform " + name + " is set but not declared");
  for (const std::string& name : declared())
    if (!locations_.contains(name)) faults.push_back("the uniform " + name + " is declared but not set");
  return faults;
}

void Program::refuseFaults() const {
  if (!strict) return;
  if (const auto faults = uniformFaults(); !faults.empty()) throw std::logic_error(faults.front());
}

void Program::set(const std::string& name, int value) const { glUniform1i(location(name), value); }

void Program::set(const std::string& name, double value) const {
  glUniform1f(location(name), static_cast<float>(value));
}

void Program::set(const std::string& name, const glm::vec2& value) const {
  glUniform2fv(location(name), 1, glm::value_ptr(value));
}

void Program::set(const std::string& name, const glm::vec3& value) const {
  glUniform3fv(location(name), 1, glm::value_ptr(value));
}

void Program::set(const std::string& name, std::span<const float> values) const {
  glUniform1fv(location(name), GLsizei(values.size()), values.data());
}

void Program::set(const std::string& name, std::span<const glm::vec4> values) const {
  glUniform4fv(location(name), GLsizei(values.size()), reinterpret_cast<const float*>(values.data()));
}

void Program::draw() const {
  refuseFaults();
  glUseProgram(program_.id());
  glBindVertexArray(vertexArray_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Program::draw(const MeshBuffer& buffer, int first, int count) const {
  refuseFaults();
  buffer.bind();
  const std::size_t start = sizeof(glm::uvec3) * static_cast<std::size_t>(first);
  glDrawElements(GL_TRIANGLES, 3 * count, GL_UNSIGNED_INT, reinterpret_cast<const void*>(start));
}

void Program::drawTiles(int columns, int rows, int side) const {
  set("tileGrid", glm::vec2(columns, rows));
  set("tileSide", static_cast<double>(side));
  refuseFaults();
  glBindVertexArray(vertexArray_.id());
  // A point whose middle is outside the viewport is left out altogether.
  std::array<GLint, 4> viewport{};
  glGetIntegerv(GL_VIEWPORT, viewport.data());
  glViewport(viewport[0], viewport[1], columns * side, rows * side);
  glEnable(GL_PROGRAM_POINT_SIZE);
  glDrawArrays(GL_POINTS, 0, columns * rows);
  glDisable(GL_PROGRAM_POINT_SIZE);
  glViewport(viewport[0], viewport[1], viewport[2], viewport[3]);
}

}  // namespace sdf::viewer
