// Turns the primitive modes of glTF into lists of triangles.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "gltf/decode/accessor.h"

namespace lavalight {

// Modes of primitives; those below are points and lines.
constexpr uint64_t kTriangleList = 4;
constexpr uint64_t kTriangleStrip = 5;
constexpr uint64_t kTriangleFan = 6;
[[nodiscard]] uint64_t modeOf(JsonView primitive);

[[nodiscard]] bool hasTriangles(JsonView primitive);

// How many triangles a primitive asks for, before any are dropped.
[[nodiscard]] size_t triangleCount(JsonView primitive, const GltfDocument& document);

// The triangles of a list, strip or fan as indices below `vertexCount`, front faces counter-clockwise.
// Triangles of a strip or fan that name a vertex twice, which join strips, are left out. Throws Error for an
// index out of range.
[[nodiscard]] std::vector<glm::uvec3> readTriangles(const GltfDocument& document, JsonView primitive,
                                                    size_t vertexCount);

} // namespace lavalight
