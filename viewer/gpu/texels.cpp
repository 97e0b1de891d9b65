#include "viewer/gpu/texels.h"

#include <epoxy/gl.h>

#include <string>
#include <vector>

namespace sdf::viewer {

Texels::Texels(int width)
    : width_(width), texture_(glGenTextures, [](unsigned id) { glDeleteTextures(1, &id); }) {}

void Texels::fill(std::span<const glm::vec4> texels) {
  const std::size_t width = static_cast<std::size_t>(width_), height = (texels.size() + width - 1) / width;
  std::vector<glm::vec4> rows(texels.begin(), texels.end());
  rows.resize(width * height);
  GLint bound = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width_, GLsizei(height), 0, GL_RGBA, GL_FLOAT, rows.data());
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  glBindTexture(GL_TEXTURE_2D, GLuint(bound));
}

void Texels::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + GLenum(unit));
  glBindTexture(GL_TEXTURE_2D, texture_.id());
}

TexelRow::TexelRow()
    : buffer_(glGenBuffers, [](unsigned id) { glDeleteBuffers(1, &id); }),
      texture_(glGenTextures, [](unsigned id) { glDeleteTextures(1, &id); }) {}

Status TexelRow::fill(std::span<const glm::vec4> texels) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  if (texels.size() > static_cast<std::size_t>(most))
    return Error{ErrorKind::Limits, "the scene has " + std::to_string(texels.size()) +
                                        " groups of numbers, and this graphics driver has room for " +
                                        std::to_string(most) + "; give it fewer parts"};
  glBindBuffer(GL_TEXTURE_BUFFER, buffer_.id());
  glBufferData(GL_TEXTURE_BUFFER, GLsizeiptr(texels.size_bytes()), texels.data(), GL_STATIC_DRAW);
  glBindTexture(GL_TEXTURE_BUFFER, texture_.id());
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer_.id());
  glBindBuffer(GL_TEXTURE_BUFFER, 0);
  return okStatus();
}

void TexelRow::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + GLenum(unit));
  glBindTexture(GL_TEXTURE_BUFFER, texture_.id());
}

}  // namespace sdf::viewer
