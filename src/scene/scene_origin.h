// Where a scene's own origin lies in the world: single precision has 24 bits a coordinate, and they are few
// where a room lies 10,000 km from where coordinates count from.
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "scene/vertex_runs.h"

namespace lavalight {

// Metres between neighbouring coordinates of single precision around this one.
[[nodiscard]] inline double resolutionAt(double coordinate) {
    return coordinate > 0.0 ? std::exp2(std::floor(std::log2(coordinate)) - 23.0) : 0.0;
}

// A camera's place, and how many metres the height of its image is.
struct Viewpoint {
    glm::dvec3 position{0.0};
    double height = 0.0; // at no distance: orthographic cameras
    double slope = 0.0;  // what it grows by a metre of distance: perspective ones
};

[[nodiscard]] Viewpoint viewpointOf(const Camera& camera, const glm::dvec3& position);

// The place from which coordinates are so short that single precision resolves best what is small, and near
// the camera. Without one, a camera that sees everything is meant. Zero on each axis that has not much to
// gain.
[[nodiscard]] glm::dvec3 chooseOrigin(std::span<const VertexRun> runs, const std::optional<Viewpoint>& view);

// The worst of the runs that single precision rounds coarsely for their size; none if there is no such run.
[[nodiscard]] std::optional<CoarseGeometry> findCoarse(std::span<const VertexRun> runs);
// Whether that holds for a run.
[[nodiscard]] bool isCoarse(const VertexRun& run);

} // namespace lavalight
