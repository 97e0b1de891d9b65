// Materials in a glTF file.
#pragma once
#include "sdf/gltf/gltf_model-inl.h"
#include "sdf/gltf/pbr.h"

namespace sdf {

/// Index of the material; parts that wear the same one share it. `emission` are the four texels of its
/// emissive texture (emission.h); empty where it has none.
int addMaterial(GltfModel& model, const std::string& name, const PbrMaterial& pbr, const glm::vec3& baseColor,
                std::span<const Texel> emission);

}  // namespace sdf
