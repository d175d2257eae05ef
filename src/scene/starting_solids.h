// The solids that camera rays start in.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "scene/view_extent.h"

namespace lavalight {

struct StartingSolids {
    glm::vec3 reference{0.0f};    // a place where rays start, in the middle of them
    std::vector<uint32_t> around; // what solidsAround() says of it
    bool vary = false;            // rays of this view may start on the other side of some boundary
};

// `nearest`: metres along the direction of view to where rays start.
[[nodiscard]] StartingSolids startingSolids(const Scene& scene, const Camera& camera, const ViewExtent& view,
                                            float nearest);

} // namespace lavalight
