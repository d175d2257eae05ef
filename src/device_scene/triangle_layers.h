// What layers of an image show of triangles beyond their geometry.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "shared/path_layers.h"

namespace lavalight {

// A record for each triangle, in the order of surfaces. Without uvs these are 0; without a next frame,
// nothing moves.
[[nodiscard]] std::vector<TriangleLayers> triangleLayers(const Scene& scene);

// Ids of surfaces, from 1: which object and which material each triangle is of.
struct SurfaceIds {
    std::vector<uint32_t> objects;
    std::vector<uint32_t> materials;
};
[[nodiscard]] SurfaceIds surfaceIds(const Scene& scene);

} // namespace lavalight
