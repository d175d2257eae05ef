// Triangles for trees: scattered ones, and rows that are hard to build over.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "accel/triangle.h"
#include "support/random_numbers.h"

namespace lavalight::test {

inline glm::vec3 randomPoint(Random& random, float reach) {
    return {random.between(-reach, reach), random.between(-reach, reach), random.between(-reach, reach)};
}

// Triangles of sides up to `size` in a cube of half side 1; large sizes make spatial splits.
inline std::vector<Triangle> scatteredTriangles(uint32_t count, float size, uint32_t seed) {
    Random random(seed);
    std::vector<Triangle> triangles;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 v0 = randomPoint(random, 1.0f);
        triangles.push_back({v0, v0 + randomPoint(random, size), v0 + randomPoint(random, size)});
    }
    return triangles;
}

inline std::vector<Triangle> scaled(std::vector<Triangle> triangles, float scale) {
    for (Triangle& t : triangles)
        t = {t.v0 * scale, t.v1 * scale, t.v2 * scale};
    return triangles;
}

// Small triangles at `perStep` of each of the distances 1, 1/2, 1/4 ... along an axis, the other coordinates
// given.
inline void addHalvingRow(std::vector<Triangle>& triangles, const glm::vec3& start, int axis, int perStep) {
    Random random(12);
    for (int power = 0; power < 120; ++power)
        for (int i = 0; i < perStep; ++i) {
            const float scale = std::ldexp(1.0f, -power);
            glm::vec3 v0 = start;
            v0[axis] = scale * random.between(0.8f, 1.0f);
            triangles.push_back(
                {v0, v0 + 0.1f * scale * random.direction(), v0 + 0.1f * scale * random.direction()});
        }
}

// Three such rows end to end: what surface areas split off a few at a time makes a tree beyond Embree's
// depth.
inline std::vector<Triangle> trianglesBeyondEmbreesDepth() {
    std::vector<Triangle> triangles;
    addHalvingRow(triangles, {0, 1, 1}, 0, 60);
    addHalvingRow(triangles, {0, 0, 1}, 1, 60);
    addHalvingRow(triangles, {0, 0, 0}, 2, 60);
    return triangles;
}

} // namespace lavalight::test
