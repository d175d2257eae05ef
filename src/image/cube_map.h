// Cube maps: six square pictures of all directions, as OpenGL and Vulkan lay them out.
#pragma once

#include <array>

#include <glm/glm.hpp>

#include "image/image.h"

namespace lavalight {

// Faces of one size in the order +X, -X, +Y, -Y, +Z, -Z; rows and columns run as in the table of cube maps
// of the Vulkan specification ("Cube Map Face Selection").
using CubeMap = std::array<Image, 6>;

// The value in a direction, which need not be of unit length: bilinear within its face.
[[nodiscard]] glm::vec3 lookUp(const CubeMap& faces, const glm::dvec3& direction);

// The cube map as an equirectangular picture (scene/scene.h, EnvironmentMap), twice as wide as four faces at
// most kMaxImageSide; `toCube` turns directions of the picture into the cube's.
[[nodiscard]] Image unrollCubeMap(const CubeMap& faces, const glm::dmat3& toCube);

} // namespace lavalight
