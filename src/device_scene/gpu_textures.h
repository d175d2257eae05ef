// Textures, and what triangles need for them, in the layout of the device.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "shared/texture.h"

namespace lavalight {

struct PackedTextures {
    std::vector<uvec4> pictures; // the pictures that materials show, four words an element
    std::vector<TextureRecord> records;
    std::vector<uint32_t> firstRecords; // per material
};

// Throws Error, with the figures, for more texels than a buffer of the device has room for.
[[nodiscard]] PackedTextures packTextures(const Scene& scene);

// The slots in which the material has a texture: bit i for slot i.
[[nodiscard]] uint32_t textureSlots(const Material& material);

// Coordinates per triangle: all sets that textures ask for; a set that a mesh has not is 0. Throws Error as
// packTextures does.
[[nodiscard]] std::vector<TriangleUvs> packUvs(const Scene& scene);
// Vertex colours per triangle; white for meshes without.
[[nodiscard]] std::vector<TriangleColors> packColors(const Scene& scene);
// Planes of tangents: one, or one for each tangent space that the textures of some material go by
// (scene/tangents.h).
[[nodiscard]] uint32_t tangentPlanes(const Scene& scene);
// Tangents per triangle, plane by plane; kNoTangents for meshes without. A mesh of fewer planes has its first
// in those that it lacks. Throws Error as packTextures does.
[[nodiscard]] std::vector<TriangleTangents> packTangents(const Scene& scene);

} // namespace lavalight
