#include "gltf/read/transform.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace lavalight {

glm::dmat4 Transform::matrix() const {
    glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), translation);
    const glm::dquat quaternion(rotation.w, rotation.x, rotation.y, rotation.z);
    // Exporters round; a quaternion that is not of unit length would scale. All zeros mean no rotation.
    if (glm::length(quaternion) > 0.0)
        matrix *= glm::mat4_cast(glm::normalize(quaternion));
    return glm::scale(matrix, scale);
}

} // namespace lavalight
