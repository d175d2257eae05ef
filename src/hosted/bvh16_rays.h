// Rays through a Bvh16. Vectors hold either the boxes of a node and the triangles of a leaf, which one ray is
// tested with, or rays that are much alike, which are tested with one box or triangle at a time.
#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "accel/bvh16.h"

namespace lavalight {

inline constexpr uint32_t kNoTriangle = 0xffffffffu;

// Where a ray meets a triangle: TriangleHit of shaders/lib/math/ray_triangle.glsl.
struct Bvh16Hit {
    float t;
    uint32_t triangle; // kNoTriangle: the ray takes none; the rest counts for nothing then
    uint32_t material; // the triangle's word in Bvh16Leaf::materials
    glm::vec2 barycentrics;
    bool front;
};

// Says whether a ray takes a triangle that it meets, as the nearest so far, or as the one that ends it. It is
// asked about triangles with kAlphaBit, and about backs where the ray culls them. `ray` is the ray's place in
// Bvh16Query::rays.
struct TriangleTaker {
    bool (*takes)(void* taker, size_t ray, const Bvh16Hit& hit);
    void* taker;
};

struct Bvh16Ray {
    glm::vec3 origin;
    glm::vec3 direction;
    float end;                            // only hits with t < end count
    uint32_t firstIgnored, secondIgnored; // triangles that are not met, or kNoTriangle
    bool cullsBackFaces;                  // those of single-sided triangles
};

// What rays look for: the triangle that comes first, or any that they take.
enum class Sought { first, any };

// Whether neighbouring rays are much alike. It changes nothing but the time that they take and, with
// Sought::any, which triangle is found.
enum class Likeness { unlike, alike };

struct Bvh16Query {
    const Bvh16& bvh;
    std::span<const Bvh16Ray> rays;
    Sought sought;
    Likeness likeness;
    TriangleTaker taker;
    std::span<Bvh16Hit> hits; // what each ray meets: one for each ray
};

// Finds for each ray the triangle that it takes before its end and that comes first: the nearest, and of
// several at one t that of the lowest number. Where triangles are met is computed to the bits of
// intersectTriangle(), after withoutZeros(), and boxes count as larger than their triangles by as much as
// that rounds, so that trees of other shapes give the same answers. With Sought::any, it finds any triangle
// that the ray takes. A ray that is not finite, or whose components sum to what is not, meets nothing.
void traverse(const Bvh16Query& query);

// traverse() by vectors of four, which every processor has. traverse() itself takes vectors of eight where it
// can.
void traverseByFour(const Bvh16Query& query);

} // namespace lavalight
