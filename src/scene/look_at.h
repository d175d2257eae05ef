// A perspective camera by where it is and what it looks at.
#pragma once

#include <optional>

#include "scene/scene.h"

namespace lavalight {

// A camera with a field of view 45 degrees high and no aspect ratio of its own. Nothing where `at` is `from`,
// or `up` is along the view.
[[nodiscard]] std::optional<Camera> lookAtCamera(const glm::vec3& from, const glm::vec3& at,
                                                 const glm::vec3& up);

} // namespace lavalight
