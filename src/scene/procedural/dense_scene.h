// A procedural scene for benchmarks: as many triangles as asked for, in which rays scatter without order.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace lavalight {

// Displaced ground, hundreds of tessellated and dented spheres and tori scattered over it and through one
// another, a bright panel under a dim sky, and a camera that sees them. Within 1 % of `triangleCount` from
// 5,000 upwards; smaller numbers give about 5,000. The same bits wherever the compiler contracts no products
// and sums (x86-64 without -mfma).
[[nodiscard]] Scene makeDenseScene(uint32_t triangleCount);

} // namespace lavalight
