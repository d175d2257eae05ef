#include "device_scene/octahedral.h"

#include <cmath>

#include <glm/gtc/packing.hpp>

namespace lavalight {

uint32_t encodeOctahedral(const glm::vec3& n) {
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    glm::vec2 p = glm::vec2(n.x, n.y) / sum;
    if (n.z < 0.0f) // fold the lower half over the diagonals
        p = {std::copysign(1.0f - std::abs(p.y), n.x), std::copysign(1.0f - std::abs(p.x), n.y)};
    return glm::packSnorm2x16(p);
}

} // namespace lavalight
