// Camera and lights in a glTF file.
#pragma once
#include "sdf/gltf/gltf_model-inl.h"

namespace sdf {

/// Adds a camera with its node, whose index it returns.
int addCamera(GltfModel& model, const ViewCamera& view, bool mirrored);

/// Adds a light with its node, whose index it returns.
int addLight(GltfModel& model, const ViewLight& view);

/// Where point lights are to have their scene's intensity: the middle of the file's meshes.
glm::dvec3 lightCentre(const GltfModel& model);

}  // namespace sdf
