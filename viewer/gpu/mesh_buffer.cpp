#include "viewer/gpu/mesh_buffer.h"

#include <epoxy/gl.h>

#include <cstddef>
#include <string>

#include "viewer/gpu/context.h"

namespace sdf::viewer {
namespace {

template <class T>
void fill(GLenum target, const std::vector<T>& values) {
  glBufferData(target, GLsizeiptr(values.size() * sizeof(T)), values.data(), GL_STATIC_DRAW);
}

void describe(GLuint input, int components, std::size_t offset) {
  glEnableVertexAttribArray(input);
  glVertexAttribPointer(input, components, GL_FLOAT, GL_FALSE, sizeof(BufferVertex),
                        reinterpret_cast<const void*>(offset));
}

}  // namespace

Result<MeshBuffer> MeshBuffer::make(const std::vector<BufferVertex>& vertices,
                                    const std::vector<glm::uvec3>& triangles) {
  MeshBuffer made;
  made.vertexArray_ = Handle(glGenVertexArrays, [](unsigned id) { glDeleteVertexArrays(1, &id); });
  made.vertices_ = Handle(glGenBuffers, [](unsigned id) { glDeleteBuffers(1, &id); });
  made.triangles_ = Handle(glGenBuffers, [](unsigned id) { glDeleteBuffers(1, &id); });
  glBindVertexArray(made.vertexArray_.id());
  glBindBuffer(GL_ARRAY_BUFFER, made.vertices_.id());
  fill(GL_ARRAY_BUFFER, vertices);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, made.triangles_.id());
  fill(GL_ELEMENT_ARRAY_BUFFER, triangles);
  describe(0, 3, offsetof(BufferVertex, position));
  describe(1, 3, offsetof(BufferVertex, normal));
  describe(2, 3, offsetof(BufferVertex, color));
  describe(3, 2, offsetof(BufferVertex, textureAt));
  describe(4, 3, offsetof(BufferVertex, ambient));
  describe(5, 1, offsetof(BufferVertex, distance));
  glBindVertexArray(0);
  if (auto s = check("keep a mesh of " + std::to_string(triangles.size()) + " triangles"); !s)
    return s.error();
  return made;
}

void MeshBuffer::bind() const { glBindVertexArray(vertexArray_.id()); }

Result<ImageTexture> ImageTexture::make(int width, int height, const std::vector<unsigned char>& pixels) {
  GLint most = 0, bound = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (width > most || height > most)
    return Error{ErrorKind::Limits, "a mesh's picture has " + std::to_string(width) + " x " +
                                        std::to_string(height) + " pixels, and this driver takes at most " +
                                        std::to_string(most) + " a side; make it smaller"};
  ImageTexture made;
  made.texture_ = Handle(glGenTextures, [](unsigned id) { glDeleteTextures(1, &id); });
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
  glBindTexture(GL_TEXTURE_2D, made.texture_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glGenerateMipmap(GL_TEXTURE_2D);
  glBindTexture(GL_TEXTURE_2D, GLuint(bound));
  if (auto s = check("keep a mesh's picture"); !s) return s.error();
  return made;
}

void ImageTexture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + GLenum(unit));
  glBindTexture(GL_TEXTURE_2D, texture_.id());
}

}  // namespace sdf::viewer
