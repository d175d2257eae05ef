// Translation, rotation and scale, as nodes, instances and animations have them.
#pragma once

#include <glm/glm.hpp>

namespace lavalight {

struct Transform {
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0}; // quaternion x, y, z, w, of any length
    glm::dvec3 scale{1.0};

    // First scale, then rotation, then translation.
    [[nodiscard]] glm::dmat4 matrix() const;
};

} // namespace lavalight
