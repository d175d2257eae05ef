// The triangles that emit light.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "shared/triangle.h"

namespace lavalight {

struct Emitter {
    uint32_t triangle = 0; // id: meshes in order, triangles in order
    float area = 0.0f;     // m^2, of one side
    double power = 0.0;    // W, mean of the three channels, of both sides where both emit
};

struct Emitters {
    std::vector<Emitter> list;
    std::vector<uint32_t> emitterOfTriangle; // per triangle of the scene: index into `list` or kNoEmitter
};

// Lists triangles of emissive materials whose area and power are positive; where there is a texture, its mean
// over the triangle counts, and a triangle that shows black alone is none. Unlit surfaces are no lights.
// Throws Error, naming the material, for a power that is not finite.
[[nodiscard]] Emitters findEmitters(const Scene& scene);

} // namespace lavalight
