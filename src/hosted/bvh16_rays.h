// Rays through a Bvh16, one at a time: the boxes of a node and the triangles of a leaf are tested side by
// side.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "accel/bvh16.h"

namespace lavalight {

// Where a ray meets a triangle: TriangleHit of shaders/lib/math/ray_triangle.glsl.
struct Bvh16Hit {
    float t;
    uint32_t triangle;
    glm::vec2 barycentrics;
    bool front;
};

// Says whether the ray takes a triangle that it meets, for the nearest so far or as the one that ends it. It
// is asked about triangles with kAlphaBit, and about backs where the ray culls them.
struct TriangleTaker {
    bool (*takes)(void* taker, const Bvh16Hit& hit);
    void* taker;
};

struct Bvh16Ray {
    glm::vec3 origin;
    glm::vec3 direction;                  // withoutZeros() of shaders/lib/math/ray_direction.glsl
    glm::vec3 shear;                      // ShearedRay of shaders/lib/math/ray_triangle.glsl
    int mainAxis;                         // the largest component of the direction
    float end;                            // only hits with t < end count
    uint32_t firstIgnored, secondIgnored; // triangles that are not met
    bool cullsBackFaces;                  // those of single-sided triangles
};

// The triangle that the ray takes before `ray.end` and that comes first: the nearest, and of several at one t
// that of the lowest number. isAny: any that it takes. Where triangles are met is computed to the bits of
// intersectTriangle(), and boxes count as larger than their triangles by as much as that rounds, so that
// trees of other shapes give the same answers. A ray that is not finite meets nothing.
[[nodiscard]] std::optional<Bvh16Hit> traverse(const Bvh16& bvh, const Bvh16Ray& ray, TriangleTaker taker,
                                               bool isAny);

// traverse() by vectors of four, which every processor has. traverse() itself takes vectors of eight where it
// can.
[[nodiscard]] std::optional<Bvh16Hit> traverseByFour(const Bvh16& bvh, const Bvh16Ray& ray,
                                                     TriangleTaker taker, bool isAny);

} // namespace lavalight
