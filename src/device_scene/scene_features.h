// What a scene has of what kernels can leave out: lib/features.glsl.
#pragma once

#include <cstdint>

#include "light/lights.h"
#include "scene/scene.h"

namespace lavalight {

// The scene's kFeature... bits (shaders/shared/scene.h). `lights`: those of the scene that have power.
[[nodiscard]] uint32_t sceneFeatures(const Scene& scene, const Lights& lights);
// Whether light passes through surfaces of the material to the inside of a volume.
[[nodiscard]] bool boundsSolid(const Material& material);
// Whether the bounding boxes of two meshes of such materials have a common inside.
[[nodiscard]] bool solidsMayOverlap(const Scene& scene);
// The bits that the camera adds.
[[nodiscard]] uint32_t cameraFeatures(const Camera& camera);

} // namespace lavalight
