// What a scene has of what kernels can leave out: lib/features.glsl.
#pragma once

#include <array>

#include "gpu/spirv_passes.h"
#include "light/lights.h"
#include "scene/scene.h"
#include "shared/features.h"

namespace lavalight {

// The scene's kFeature... bits (shaders/shared/features.h). `lights`: those of the scene that have power.
[[nodiscard]] SceneFeatures sceneFeatures(const Scene& scene, const Lights& lights);
// Whether light passes through surfaces of the material to the inside of a volume.
[[nodiscard]] bool boundsSolid(const Material& material);
// Whether the bounding boxes of two meshes of such materials have a common
// inside.
[[nodiscard]] bool solidsMayOverlap(const Scene& scene);
// The bits that the camera adds.
[[nodiscard]] SceneFeatures cameraFeatures(const Camera& camera);

// The two specialisation constants that hold the features.
[[nodiscard]] std::array<gpu::SpecialisationConstant, 2> featureConstants(SceneFeatures features);

} // namespace lavalight
