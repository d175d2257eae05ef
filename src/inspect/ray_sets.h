// Rays of the three kinds that a path tracer traces, made on the host: for benchmarks and tests of traversal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/triangle.h"
#include "scene/scene.h"
#include "shared/trace.h"
#include "shared/wavefront.h"

namespace lavalight {

// That starts on no surface.
[[nodiscard]] inline Ray freeRay(const glm::vec3& origin, const glm::vec3& direction) {
    return {origin, kNoSurface, direction, 0.0f, 0, {}};
}

// About `count` rays through random points of the pixels of an image, row by row.
[[nodiscard]] std::vector<Ray> makeCameraRays(const Camera& camera, size_t count, uint32_t seed);

// What the rays hit, on the side they came from.
struct SurfacePoint {
    glm::vec3 p{0.0f};
    glm::vec3 ng{0.0f, 0.0f, 1.0f}; // unit length
};

// The points that were hit, in the order of the rays, moved off the surface by 1e-5 of the distance and the
// coordinates: more than rounding, since other programs than ours trace these rays too and do not skip
// triangles by id.
[[nodiscard]] std::vector<SurfacePoint> hitPoints(std::span<const Ray> rays, std::span<const TracedHit> hits,
                                                  std::span<const Triangle> triangles);

// One ray a point, by the cosine.
[[nodiscard]] std::vector<Ray> makeBounceRays(std::span<const SurfacePoint> points, uint32_t seed);

// One ray a point: towards a random place on a random light (by power), ending shortly before it; in a scene
// without emissive triangles by the cosine, as long as the scene is wide.
[[nodiscard]] std::vector<ShadowRay> makeShadowRays(std::span<const SurfacePoint> points, const Scene& scene,
                                                    std::span<const Triangle> triangles, uint32_t seed);

} // namespace lavalight
