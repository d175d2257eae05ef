// Which parts of a scene the planes of a camera cut off.
#pragma once

#include <cstdint>
#include <limits>

#include "scene/scene.h"
#include "scene/view_extent.h"

namespace lavalight {

// Where camera rays start and how far they reach, in metres along the direction of view.
struct ClipRange {
    float nearest = 0.0f;
    float depth = std::numeric_limits<float>::infinity(); // without end
};

// The planes that have something to cut off in this view; the others are left out, since moving the start of
// a ray changes the last bits of an image.
[[nodiscard]] ClipRange neededClipping(const Scene& scene, const Camera& camera, const ViewExtent& view);

// Triangles of the view that reach beyond the far plane.
[[nodiscard]] uint64_t trianglesBeyondFar(const Scene& scene, const Camera& camera, const ViewExtent& view);

} // namespace lavalight
