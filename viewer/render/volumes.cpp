#include "viewer/render/volumes.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

#include "viewer/gpu/context.h"

namespace sdf::viewer {
namespace {

constexpr int kFirstUnit = 8;  // beyond those of starts, layers and rows

int limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

Result<Handle> textureOf(const PayloadVolume& volume) {
  const int side = limit(GL_MAX_3D_TEXTURE_SIZE);
  if (std::max({volume.size.x, volume.size.y, volume.size.z}) > side)
    return Error{ErrorKind::Limits, "a mesh's samples need a texture of " + std::to_string(volume.size.x) +
                                        " x " + std::to_string(volume.size.y) + " x " +
                                        std::to_string(volume.size.z) + ", and this driver has at most " +
                                        std::to_string(side) + " a side; give the mesh fewer voxels"};
  Handle texture(glGenTextures, [](unsigned id) { glDeleteTextures(1, &id); });
  GLint bound = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_3D, &bound);
  glBindTexture(GL_TEXTURE_3D, texture.id());
  const auto byChannels = [&](GLenum one, GLenum two, GLenum four) {
    return volume.channels == 1 ? one : volume.channels == 2 ? two : four;
  };
  const GLenum format =
      volume.halves ? byChannels(GL_R16F, GL_RG16F, GL_RGBA16F) : byChannels(GL_R32F, GL_RG32F, GL_RGBA32F);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage3D(GL_TEXTURE_3D, 0, GLint(format), volume.size.x, volume.size.y, volume.size.z, 0,
               byChannels(GL_RED, GL_RG, GL_RGBA), GL_FLOAT, volume.values.data());
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_3D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTexParameteri(GL_TEXTURE_3D, wrap, GL_CLAMP_TO_EDGE);
  glBindTexture(GL_TEXTURE_3D, GLuint(bound));
  if (auto made = check("keep a mesh's samples"); !made) return made.error();
  return texture;
}

}  // namespace

Status Volumes::giveTo(const Program& program, const std::vector<ShaderVolume>& volumes) {
  for (const ShaderVolume& v : volumes) {
    const auto [unit, isNew] =
        units_.try_emplace({v.payload.get(), v.number}, kFirstUnit + static_cast<int>(textures_.size()));
    if (isNew) {
      if (unit->second >= limit(GL_MAX_TEXTURE_IMAGE_UNITS))
        return Error{ErrorKind::Limits, "this driver has no room for the samples of more than " +
                                            std::to_string(textures_.size() / v.payload->volumes().size()) +
                                            " meshes that are marched; draw some as triangles"};
      auto texture = textureOf(v.payload->volumes()[v.number]);
      if (!texture) return texture.error();
      textures_.push_back({v.payload, std::move(*texture)});
    }
    program.set(v.sampler, unit->second);
  }
  return okStatus();
}

Status Volumes::follow(const std::vector<ShaderVolume>& before, const std::vector<ShaderVolume>& after) {
  decltype(units_) units;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const int unit = units_.at({before[i].payload.get(), before[i].number});
    const auto& payload = after[i].payload;
    const bool isNew = units.try_emplace({payload.get(), after[i].number}, unit).second;
    Texture& own = textures_[static_cast<std::size_t>(unit - kFirstUnit)];
    if (!isNew || own.payload == payload) continue;
    auto texture = textureOf(payload->volumes()[after[i].number]);
    if (!texture) return texture.error();
    own = {payload, std::move(*texture)};
  }
  units_ = std::move(units);
  return okStatus();
}

void Volumes::bind() const {
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    glActiveTexture(GL_TEXTURE0 + GLenum(kFirstUnit) + GLenum(i));
    glBindTexture(GL_TEXTURE_3D, textures_[i].handle.id());
  }
}

}  // namespace sdf::viewer
