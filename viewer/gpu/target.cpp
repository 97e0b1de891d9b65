#include "viewer/gpu/target.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "viewer/gpu/context.h"

namespace sdf::viewer {
namespace {

constexpr GLint kInternalFormats[] = {GL_RGBA8, GL_RG32F, GL_RGBA32F};  // by PixelFormat

std::string product(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

Status checkSize(int width, int height) {
  const Driver driver = currentDriver();
  if (width >= 1 && height >= 1 && width <= driver.mostWidth && height <= driver.mostHeight)
    return okStatus();
  return Error{ErrorKind::Limits, "cannot draw " + product(width, height) +
                                      " pixels: this driver draws from 1 x 1 to " +
                                      product(driver.mostWidth, driver.mostHeight)};
}

/// Puts back at its end what was bound at its start.
class KeepBound {
 public:
  KeepBound() {
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &texture_);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
  }
  ~KeepBound() {
    glBindTexture(GL_TEXTURE_2D, GLuint(texture_));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(draw_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(read_));
  }
  KeepBound(const KeepBound&) = delete;
  KeepBound& operator=(const KeepBound&) = delete;

 private:
  GLint texture_ = 0, draw_ = 0, read_ = 0;
};

/// OpenGL's rows start at the bottom.
template <class T>
void flipRows(std::vector<T>& values, int height) {
  const std::size_t row = values.size() / std::size_t(height);
  for (std::size_t top = 0, bottom = std::size_t(height) - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(values.begin() + std::ptrdiff_t(top * row),
                     values.begin() + std::ptrdiff_t((top + 1) * row),
                     values.begin() + std::ptrdiff_t(bottom * row));
}

}  // namespace

Result<Target> Target::create(int width, int height, const std::vector<PixelFormat>& layers, bool depth) {
  assert(!layers.empty());
  if (const Status fits = checkSize(width, height); !fits) return fits.error();
  const KeepBound bindings;
  Target target(width, height);
  target.step_ = layers.front() == PixelFormat::Rgba8 ? 1.0 / 255.0 : 0.0;
  target.framebuffer_ = Handle(glGenFramebuffers, [](unsigned id) { glDeleteFramebuffers(1, &id); });
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer_.id());
  for (const PixelFormat format : layers)
    if (const Status added = target.addLayer(format); !added) return added.error();
  if (depth)
    if (const Status added = target.addDepth(); !added) return added.error();
  std::vector<GLenum> outputs;
  for (std::size_t i = 0; i < layers.size(); ++i) outputs.push_back(GL_COLOR_ATTACHMENT0 + GLenum(i));
  glDrawBuffers(GLsizei(outputs.size()), outputs.data());

  if (const GLenum state = glCheckFramebufferStatus(GL_FRAMEBUFFER); state != GL_FRAMEBUFFER_COMPLETE)
    return Error{ErrorKind::Graphics, "the driver cannot draw into " + product(width, height) +
                                          " pixels of this format (" + std::to_string(state) + ")"};
  return target;
}

Status Target::addLayer(PixelFormat format) {
  const GLenum place = GL_COLOR_ATTACHMENT0 + GLenum(textures_.size());
  textures_.emplace_back(glGenTextures, [](unsigned id) { glDeleteTextures(1, &id); });
  const GLuint texture = textures_.back().id();
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, kInternalFormats[static_cast<int>(format)], width_, height_, 0, GL_RGBA,
               GL_FLOAT, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  glFramebufferTexture2D(GL_FRAMEBUFFER, place, GL_TEXTURE_2D, texture, 0);
  return check("make a picture of " + product(width_, height_) + " pixels");
}

Status Target::addDepth() {
  depth_ = Handle(glGenRenderbuffers, [](unsigned id) { glDeleteRenderbuffers(1, &id); });
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width_, height_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  return check("make depths for " + product(width_, height_) + " pixels");
}

void Target::bind() const { bind(0, 0, width_, height_); }

void Target::bind(int x, int y, int width, int height) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(x, y, width, height);
}

void Target::clear(int layer, const glm::vec4& value) const {
  bind();
  glClearBufferfv(GL_COLOR, layer, glm::value_ptr(value));
}

void Target::clearDepth() const {
  bind();
  const float farthest = 1.0f;
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void Target::show(int width, int height) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  const bool same = width == width_ && height == height_;
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                    same ? GL_NEAREST : GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
}

void Target::bindTexture(int unit, int layer) const {
  glActiveTexture(GL_TEXTURE0 + GLenum(unit));
  glBindTexture(GL_TEXTURE_2D, textures_[std::size_t(layer)].id());
}

Status Target::read(int layer, unsigned type, void* rowsFromBottom) const {
  const KeepBound bindings;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
  glReadBuffer(GL_COLOR_ATTACHMENT0 + GLenum(layer));
  glReadPixels(0, 0, width_, height_, GL_RGBA, type, rowsFromBottom);
  return check("read the picture back");
}

Result<std::vector<glm::vec4>> Target::pixels(int layer) const {
  std::vector<glm::vec4> rows(std::size_t(width_) * std::size_t(height_));
  if (const Status done = read(layer, GL_FLOAT, rows.data()); !done) return done.error();
  flipRows(rows, height_);
  return rows;
}

Result<glm::dvec4> Target::sum(int layer) const {
  const auto all = pixels(layer);
  if (!all) return all.error();
  glm::dvec4 sum(0.0);
  for (const glm::vec4& p : *all) sum += glm::dvec4(p);
  return sum;
}

Result<Picture> Target::picture(int layer) const {
  constexpr int kChannels = 4;
  Picture picture{width_, height_, kChannels, {}};
  picture.bytes.resize(std::size_t(width_) * std::size_t(height_) * kChannels);
  if (const Status done = read(layer, GL_UNSIGNED_BYTE, picture.bytes.data()); !done) return done.error();
  flipRows(picture.bytes, height_);
  return picture;
}

Status ensure(std::optional<Target>& target, int width, int height, const std::vector<PixelFormat>& layers,
              bool depth) {
  if (target && target->width() == width && target->height() == height) return okStatus();
  return keep(Target::create(width, height, layers, depth), target);
}

DrawingMode nearestWins() {
  glEnable(GL_DEPTH_TEST);
  return DrawingMode([] { glDisable(GL_DEPTH_TEST); });
}

DrawingMode sumOfAll() {
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  glBlendEquation(GL_FUNC_ADD);
  return DrawingMode([] { glDisable(GL_BLEND); });
}

DrawingMode leastOfAll() {
  glEnable(GL_BLEND);
  glBlendEquation(GL_MIN);
  return DrawingMode([] { glDisable(GL_BLEND); });
}

DrawingMode firstLayers(int count) {
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  for (int i = 0; i < count; ++i) glColorMaski(GLuint(i), GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  return DrawingMode([] { glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE); });
}

DrawingMode somePixels(int firstRow, int rows, int firstColumn, int columns) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(firstColumn, firstRow, columns, rows);
  return DrawingMode([] { glDisable(GL_SCISSOR_TEST); });
}

DrawingMode oneLayer(int layer) {
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glColorMaski(GLuint(layer), GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  return DrawingMode([] { glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE); });
}

}  // namespace sdf::viewer
