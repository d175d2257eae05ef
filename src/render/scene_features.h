// What a scene has of what kernels can leave out: lib/features.glsl.
#pragma once

#include <cstdint>

#include "light/lights.h"
#include "scene/scene.h"

namespace lavalight {

// kFeature... bits of shaders/shared/scene.h. `lights`: those of the scene that have power.
[[nodiscard]] uint32_t sceneFeatures(const Scene& scene, const Lights& lights);
// Those that the camera adds.
[[nodiscard]] uint32_t cameraFeatures(const Camera& camera);

} // namespace lavalight
