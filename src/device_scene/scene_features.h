// What a scene has of what kernels can leave out: lib/features.glsl.
#pragma once

#include <array>
#include <vector>

#include "gpu/spirv_passes.h"
#include "light/lights.h"
#include "scene/scene.h"
#include "shared/features.h"

namespace lavalight {

// The scene's kFeature... bits (shaders/shared/features.h). `lights`: those of the scene that have power.
[[nodiscard]] SceneFeatures sceneFeatures(const Scene& scene, const Lights& lights);
// The bits of them that come from surfaces, for each material of the scene: its own, and those of the meshes
// that wear it. None for a material that no mesh wears.
[[nodiscard]] std::vector<SceneFeatures> surfaceFeatures(const Scene& scene);
// Whether paths have to know which solids they are in: where these attenuate, overlap or touch, or are thin
// for their distance from the origin. Elsewhere the side of a surface tells all that matters.
[[nodiscard]] bool wantsInteriorLists(const Scene& scene);
// The bits that the camera adds.
[[nodiscard]] SceneFeatures cameraFeatures(const Camera& camera);

// The two specialisation constants that hold the features.
[[nodiscard]] std::array<gpu::SpecialisationConstant, 2> featureConstants(SceneFeatures features);

} // namespace lavalight
