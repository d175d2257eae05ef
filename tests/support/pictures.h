// Pictures for tests, and textures that show them.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lavalight::test {

// A picture of texels row by row from the top, RGBA in 0 to 255.
[[nodiscard]] Picture pictureOf(uint32_t width, uint32_t height, const std::vector<glm::uvec4>& texels);

// A picture of random texels.
[[nodiscard]] Picture noisePicture(uint32_t width, uint32_t height, bool is16Bit, uint32_t seed);

// A texture that is linear, nearest, repeated, and of the first uv set.
[[nodiscard]] Texture textureOf(uint32_t picture);

// Shows `texture` in a slot of the mesh's material; the mesh is a rectangle() with u along halfU and v along
// halfV, from 0 to 1.
void putOnRectangle(Scene& scene, size_t mesh, TextureSlot slot, const Texture& texture);

} // namespace lavalight::test
