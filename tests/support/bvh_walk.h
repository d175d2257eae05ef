// The flattened tree read the plain way: boxes decoded in double, recursion, no tolerances; for tests.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>

#include "accel/bvh.h"
#include "inspect/embree_oracle.h"

namespace lavalight::test {

struct Box {
    glm::dvec3 lower, upper;

    [[nodiscard]] bool contains(const glm::dvec3& p) const {
        return glm::all(glm::lessThanEqual(lower, p)) && glm::all(glm::lessThanEqual(p, upper));
    }
    [[nodiscard]] bool isEmpty() const { return glm::any(glm::greaterThan(lower, upper)); }
};

// The box of a slot, exact where origin and extent are within 2^29 of each other in size.
inline Box childBox(const BvhNode& node, uint32_t slot) {
    Box box{};
    const auto byte = [&](const glm::uvec2& plane) {
        return plane[static_cast<int>(slot / 4)] >> (8 * (slot % 4)) & 0xffu;
    };
    for (int axis = 0; axis < 3; ++axis) {
        const double step = std::ldexp(1.0, static_cast<int>(node.exponents >> (8 * axis) & 0xffu) - 127);
        box.lower[axis] = node.origin[axis] + byte(node.lower[axis]) * step;
        box.upper[axis] = node.origin[axis] + byte(node.upper[axis]) * step;
    }
    return box;
}

// What lies in a slot, as traversal refers to it.
inline uint32_t childReference(const BvhNode& node, uint32_t slot) {
    const BvhChildren& children = node.children;
    const uint32_t content = children.slots[static_cast<int>(slot / 4)] >> (8 * (slot % 4)) & 0xffu;
    const uint32_t count = content >> kSlotCountShift;
    const uint32_t offset = content & kSlotOffsetMask;
    return count == kSlotIsNode ? children.firstNode + offset
                                : kLeafBit | count << kLeafCountShift | (children.firstTriangle + offset);
}

// The triangles of a leaf reference.
inline std::span<const uint32_t> leafOf(const Bvh& bvh, uint32_t reference) {
    return std::span(bvh.leafTriangles)
        .subspan(reference & kLeafFirstMask, reference >> kLeafCountShift & kLeafCountMask);
}

inline bool isLeaf(uint32_t reference) {
    return (reference & kLeafBit) != 0;
}

// Calls visit(node index, slot, level) for every slot below a node, the root's level being 1.
inline void forEachSlot(const Bvh& bvh, const std::function<void(uint32_t, uint32_t, uint32_t)>& visit,
                        uint32_t node = 0, uint32_t level = 1) {
    for (uint32_t slot = 0; slot < kBvhWidth; ++slot) {
        visit(node, slot, level);
        if (const uint32_t reference = childReference(bvh.nodes[node], slot); !isLeaf(reference))
            forEachSlot(bvh, visit, reference, level + 1);
    }
}

// Distance to a triangle in double, or infinity. Based on: Moeller, Trumbore, 1997.
inline double hitDistance(const Triangle& triangle, const OracleRay& ray) {
    const glm::dvec3 v0(triangle.v0), d(ray.direction);
    const glm::dvec3 e1 = glm::dvec3(triangle.v1) - v0;
    const glm::dvec3 e2 = glm::dvec3(triangle.v2) - v0;
    const glm::dvec3 s = glm::dvec3(ray.origin) - v0;
    const double determinant = glm::dot(e1, glm::cross(d, e2));
    const double b1 = glm::dot(s, glm::cross(d, e2)) / determinant;
    const double b2 = glm::dot(d, glm::cross(s, e1)) / determinant;
    const double t = glm::dot(e2, glm::cross(s, e1)) / determinant;
    const bool hit =
        determinant != 0.0 && b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0 && t > 0.0 && t <= ray.tMax;
    return hit ? t : std::numeric_limits<double>::infinity();
}

// Whether the ray meets a box before tMax; rounding of doubles may let near misses in, never hits out.
inline bool meets(const Box& box, const OracleRay& ray) {
    double enter = 0.0;
    double leave = ray.tMax;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = ray.direction[axis];
        if (d == 0.0) {
            if (ray.origin[axis] < box.lower[axis] || ray.origin[axis] > box.upper[axis])
                return false;
            continue;
        }
        const double t0 = (box.lower[axis] - ray.origin[axis]) / d;
        const double t1 = (box.upper[axis] - ray.origin[axis]) / d;
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
    }
    return enter <= leave + 1e-12 * (1.0 + std::abs(leave));
}

// The closest hit: of triangles at equal distance that of the lowest id, as on the device.
struct WalkHit {
    double t = std::numeric_limits<double>::infinity(); // infinity: nothing is hit
    uint32_t triangle = 0xffffffffu;

    bool operator==(const WalkHit&) const = default;
    void keepFirst(const WalkHit& other) {
        if (other.t < t || (other.t == t && other.triangle < triangle))
            *this = other;
    }
};

// By way of the tree.
inline WalkHit closestInTree(const Bvh& bvh, std::span<const Triangle> triangles, const OracleRay& ray,
                             uint32_t node = 0) {
    WalkHit closest;
    for (uint32_t slot = 0; slot < kBvhWidth; ++slot) {
        if (!meets(childBox(bvh.nodes[node], slot), ray))
            continue;
        const uint32_t reference = childReference(bvh.nodes[node], slot);
        if (!isLeaf(reference))
            closest.keepFirst(closestInTree(bvh, triangles, ray, reference));
        else
            for (const uint32_t id : leafOf(bvh, reference))
                if (const double t = hitDistance(triangles[id], ray); std::isfinite(t))
                    closest.keepFirst({t, id});
    }
    return closest;
}

// By way of every triangle.
inline WalkHit closestOfAll(std::span<const Triangle> triangles, const OracleRay& ray) {
    WalkHit closest;
    for (uint32_t id = 0; id < triangles.size(); ++id)
        if (const double t = hitDistance(triangles[id], ray); std::isfinite(t))
            closest.keepFirst({t, id});
    return closest;
}

} // namespace lavalight::test
