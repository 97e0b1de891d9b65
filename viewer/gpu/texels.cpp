#include "viewer/gpu/texels.h"

#include <epoxy/gl.h>

#include <algorithm>
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
  GLint room = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &room);
  // Floats, which say where something is, tell so many apart.
  const std::size_t most = std::min(static_cast<std::size_t>(room), std::size_t{1} << 24);
  if (texels.size() > most)
    return Error{ErrorKind::Limits, "the scene's parts take " + std::to_string(texels.size()) +
                                        " texels, and there is room for " + std::to_string(most) +
                                        "; draw it with --no-culling, or give it fewer parts"};
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
