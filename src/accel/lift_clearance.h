// Room above smooth-shaded triangles, where rays start that leave the smooth surface
// (shaders/lib/math/smooth_surface.glsl).
#pragma once

#include <span>
#include <vector>

#include "accel/triangle.h"
#include "scene/scene.h"

namespace lavalight {

// Marks each triangle of `triangles` (sceneTriangles() of the scene) whose smooth surface another surface may
// pierce or cover. A ray that started on that smooth surface could start behind the other one, so rays start
// on the triangle itself. Neighbours that share a vertex and its normal belong to the same smooth surface.
// Empty: no triangle is marked.
[[nodiscard]] std::vector<bool> crowdedLifts(const Scene& scene, std::span<const Triangle> triangles);

} // namespace lavalight
