// What shaders of payloads read beside uniforms.
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "sdf/eval/glsl.h"
#include "sdf/expr/payload.h"

namespace sdf::viewer {

/// A ShaderVolume is what a sampler of a shader reads: one of a payload's volumes.
struct ShaderVolume {
  std::string sampler;
  std::shared_ptr<const Payload> payload;
  std::size_t number;
};

/// Returns what a writer's source reads.
inline std::vector<ShaderVolume> volumesOf(const GlslWriter& writer) {
  std::vector<ShaderVolume> all;
  for (const auto& [name, payload] : writer.payloads())
    for (std::size_t i = 0; i < payload->volumes().size(); ++i)
      all.push_back({name + payload->volumes()[i].name, payload, i});
  return all;
}

}  // namespace sdf::viewer
