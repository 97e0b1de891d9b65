#include "viewer/shaders/glsl_probe.h"

#include <epoxy/gl.h>

#include <stdexcept>

#include "sdf/eval/glsl.h"
#include "viewer/gpu/context.h"
#include "viewer/gpu/program.h"
#include "viewer/gpu/target.h"
#include "viewer/render/volumes.h"

namespace sdf::test {
namespace {

constexpr int kProbeWidth = 4096;

/// A texture of vectors, rows of kProbeWidth, bound to a unit while it lives.
class Vectors {
 public:
  Vectors(int unit, std::vector<glm::vec4> texels) {
    const int height = static_cast<int>(texels.size()) / kProbeWidth;
    glGenTextures(1, &texture_);
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kProbeWidth, height, 0, GL_RGBA, GL_FLOAT, texels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  ~Vectors() { glDeleteTextures(1, &texture_); }
  Vectors(const Vectors&) = delete;
  Vectors& operator=(const Vectors&) = delete;

 private:
  GLuint texture_ = 0;
};

template <class Value>
Value must(Result<Value> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

// How `values[i]` of `count` outputs is called for, and the main() that stores them four to a layer.
std::string mainOf(std::size_t count) {
  std::string text = "uniform sampler2D points, normals;\n";
  const std::size_t layers = (count + 3) / 4;
  for (std::size_t i = 0; i < layers; ++i)
    text += "layout(location = " + std::to_string(i) + ") out vec4 layer" + std::to_string(i) + ";\n";
  text +=
      "void main() {\n  sdfTakeValues();\n  ivec2 at = ivec2(int(gl_FragCoord.x), textureSize(points, 0).y - "
      "1 - "
      "int(gl_FragCoord.y));\n  vec3 p = texelFetch(points, at, 0).xyz, n = texelFetch(normals, at, "
      "0).xyz;\n";
  if (count == 1) {
    text += "  layer0.x = read(p, n);\n";
  } else if (count == 3) {
    text += "  layer0.xyz = read(p, n);\n";
  } else {
    text += "  float values[" + std::to_string(count) + "];\n  read(p, n, values);\n";
    for (std::size_t i = 0; i < count; ++i)
      text += "  layer" + std::to_string(i / 4) + "[" + std::to_string(i % 4) + "] = values[" +
              std::to_string(i) + "];\n";
  }
  return text + "}\n";
}

viewer::Target targetOf(int height, std::size_t layers) {
  using enum viewer::PixelFormat;
  switch (layers) {
    case 1:
      return must(viewer::Target::create(kProbeWidth, height, {Rgba32f}));
    case 5:
      return must(viewer::Target::create(kProbeWidth, height, {Rgba32f, Rgba32f, Rgba32f, Rgba32f, Rgba32f}));
    default:
      throw std::runtime_error("a probe has up to 4 or from 17 to 20 outputs");
  }
}

}  // namespace

std::vector<std::vector<float>> readByShader(std::span<const Expr> outputs, std::span<const Place> places,
                                             const std::map<std::string, double>& parameters) {
  GlslWriter writer;
  writer.add("read", outputs);
  const auto program =
      must(viewer::Program::overScreen("#version 330 core\n" + writer.source() + mainOf(outputs.size())));
  const int height = static_cast<int>((places.size() + kProbeWidth - 1) / kProbeWidth);
  std::vector<glm::vec4> points(static_cast<std::size_t>(height) * kProbeWidth), normals = points;
  for (std::size_t i = 0; i < places.size(); ++i)
    points[i] = glm::vec4(places[i].p, 0.0f), normals[i] = glm::vec4(places[i].n, 0.0f);
  const Vectors pointTexture(0, std::move(points)), normalTexture(1, std::move(normals));
  program.set("points", 0);
  program.set("normals", 1);
  const std::vector<double> values = writer.uniforms().uniform(parameters);
  std::vector<glm::vec4> rows((values.size() + 3) / 4);
  for (std::size_t i = 0; i < values.size(); ++i)
    rows[i / 4][static_cast<int>(i % 4)] = static_cast<float>(values[i]);
  if (!rows.empty()) program.set("sdfValues", rows);
  viewer::Volumes volumes;
  must(volumes.giveTo(program, viewer::volumesOf(writer)));
  volumes.bind();
  const std::size_t layers = (outputs.size() + 3) / 4;
  const viewer::Target target = targetOf(height, layers);
  target.bind();
  program.draw();
  std::vector<std::vector<float>> result(places.size(), std::vector<float>(outputs.size()));
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const auto pixels = must(target.pixels(static_cast<int>(layer)));
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t k = 4 * layer; k < std::min(outputs.size(), 4 * layer + 4); ++k)
        result[i][k] = pixels[i][static_cast<int>(k % 4)];
  }
  return result;
}

}  // namespace sdf::test
