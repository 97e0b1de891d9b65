#include "viewer/render/hits_target.h"

#include "viewer/render/tiles.h"

namespace sdf::viewer {
namespace {

/// A layer, by the name of the output and the sampler in parts.cpp.
struct Layer {
  const char* name;
  PixelFormat format;
  glm::vec4 nothing;  ///< what it holds where there is no hit
};

constexpr Layer kLayers[HitsTarget::kCounts] = {
    {"hitSurface", PixelFormat::Rgba32f, glm::vec4(0.0f, 0.0f, 0.0f, 1e30f)},
    {"hitIdentity", PixelFormat::Rg32f, glm::vec4(0.0f)},
};

}  // namespace

Status HitsTarget::resize(int width, int height, bool counted) {
  std::vector<PixelFormat> formats;
  for (const Layer& layer : kLayers) formats.push_back(layer.format);
  if (counted) formats.push_back(PixelFormat::Rgba32f);
  return ensure(target_, width, height, formats, true);
}

void HitsTarget::clear() const {
  for (int i = 0; i < kCounts; ++i) target_->clear(i, kLayers[i].nothing);
  target_->clearDepth();
}

void HitsTarget::clearCounts() const { target_->clear(kCounts, glm::vec4(0.0f)); }

void HitsTarget::giveTo(const Program& program) const {
  for (int i = 0; i < kCounts; ++i) {
    target_->bindTexture(i, i);
    program.set(kLayers[i].name, i);
  }
}

Result<double> HitsTarget::readings() const {
  const auto sum = target_->sum(kCounts);
  if (!sum) return sum.error();
  return sum->x;
}

}  // namespace sdf::viewer
