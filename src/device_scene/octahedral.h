// Packs unit vectors into 32 bits; shaders/lib/octahedral.glsl unpacks them.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace lavalight {

// The octahedral map as two 16-bit signed normalised numbers. Cigolle et al., "A Survey of Efficient
// Representations for Independent Unit Vectors", JCGT 3(2), 2014. `n` has unit length; the angle to what
// comes back is below 1e-4.
[[nodiscard]] uint32_t encodeOctahedral(const glm::vec3& n);

} // namespace lavalight
