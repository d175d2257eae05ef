// Embree's own ray traversal over the same triangles: the truth for tests and the yardstick for benchmarks.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "accel/embree_triangles.h"
#include "accel/triangle.h"

namespace lavalight {

struct OracleRay {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f, 0.0f, 1.0f};
    float tMax = std::numeric_limits<float>::infinity();
};

struct OracleHit {
    float t = std::numeric_limits<float>::infinity(); // infinity: nothing was hit
    uint32_t triangle = 0;
};

class EmbreeOracle {
  public:
    enum class Traversal { fast, robust }; // robust: rays do not slip through shared edges

    // Throws Error when Embree fails.
    EmbreeOracle(std::span<const Triangle> triangles, Traversal traversal);

    // Both return a hit or flag per ray, of triangles at 0 < t <= tMax from either side. Rays go one by one,
    // on the calling thread.
    [[nodiscard]] std::vector<OracleHit> closest(std::span<const OracleRay> rays) const;
    [[nodiscard]] std::vector<uint8_t> occluded(std::span<const OracleRay> rays) const;

  private:
    EmbreeTriangles triangles_;
};

} // namespace lavalight
