// Lights in the layout of the device.
#pragma once

#include <vector>

#include "accel/bvh.h"
#include "light/lights.h"
#include "scene/scene.h"
#include "shared/scene.h"

namespace lavalight {

[[nodiscard]] std::vector<LightRecord> packLights(const Lights& lights, const Bvh& bvh);
[[nodiscard]] std::vector<PunctualRecord> packPunctuals(const Scene& scene, const Lights& lights);

// Spheres and cones are rounded outwards, so that no light is thought dark where it shines. Intensities
// become numbers near 1 seen from `sceneRadius` away: only their ratios matter, and single precision must
// hold their quotients by squared distances.
[[nodiscard]] std::vector<LightTreeRecord> packLightTree(const LightTree& tree, double sceneRadius);

} // namespace lavalight
