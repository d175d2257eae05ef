// Lights in the layout of the device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "light/lights.h"
#include "scene/scene.h"
#include "shared/scene.h"

namespace lavalight {

// Emissive triangles by their numbers in the scene, as kernels do not know them: inRecords() turns them.
[[nodiscard]] std::vector<LightRecord> packLights(const Lights& lights);
// `recordOfTriangle`: of each triangle of the scene, in the accelerator.
[[nodiscard]] std::vector<LightRecord> inRecords(std::vector<LightRecord> lights,
                                                 std::span<const uint32_t> recordOfTriangle);
[[nodiscard]] std::vector<PunctualRecord> packPunctuals(const Scene& scene, const Lights& lights);

// Spheres and cones are rounded outwards, so that no light is thought dark where it shines. Intensities
// become numbers near 1 seen from `sceneRadius` away: only their ratios matter, and single precision must
// hold their quotients by squared distances.
[[nodiscard]] std::vector<LightTreeRecord> packLightTree(const LightTree& tree, double sceneRadius);

} // namespace lavalight
