// The binary tree between the builders and the flattening, and how it collapses to a wide one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "accel/bvh.h"

namespace lavalight {

struct BuildBox {
    glm::vec3 lower{std::numeric_limits<float>::infinity()};
    glm::vec3 upper{-std::numeric_limits<float>::infinity()};

    void extend(const BuildBox& other) {
        lower = glm::min(lower, other.lower);
        upper = glm::max(upper, other.upper);
    }
    // Surface area of a box, in double: squares of kMaxCoordinate overflow nothing.
    [[nodiscard]] double area() const {
        const glm::dvec3 e = glm::dvec3(upper) - glm::dvec3(lower);
        return 2.0 * (e.x * e.y + e.y * e.z + e.z * e.x);
    }
};

// The cheapest ways to hand a subtree to a wide tree: what Plan decides and collapsing carries out.
struct Plan {
    std::array<double, kBvhWidth>
        cost{}; // [i]: cost of the subtree as at most i + 1 children of one wide node
    std::array<uint8_t, kBvhWidth> roots{}; // [i]: how many children that is, 1 to i + 1
    std::array<uint8_t, kBvhWidth> share{}; // [i]: of i + 1 children, i > 0, how many come from the left
    bool isLeaf = true;                     // where the subtree is one child: a leaf of all its triangles
};

// A reference to one triangle, or an inner node with two children, which lie in the arena that made the node.
struct BuildNode {
    BuildBox box; // around the part of the triangles that lies in this subtree
    std::array<const BuildNode*, 2> children{};
    uint32_t triangle = 0; // id, for a reference
    uint32_t count = 1;    // references in this subtree
    Plan plan;
};

// Make the two kinds complete, plan included. The children have been made before.
void makeReference(BuildNode& node, uint32_t triangle, const BuildBox& box, float triangleCost);
void makeInner(BuildNode& node, const BuildNode& left, const BuildNode& right, float triangleCost);

[[nodiscard]] BuildBox triangleBox(const Triangle& triangle);

// Halves the triangles at the median of their centres: a plain tree, but at most ceil(log2(n)) levels high
// for every input. Nodes are added to `arena`. `ids` must not be empty; it is reordered.
[[nodiscard]] const BuildNode* buildMedianTree(std::span<const Triangle> triangles, std::span<uint32_t> ids,
                                               float triangleCost, std::deque<BuildNode>& arena);

struct WideChild {
    const BuildNode* subtree = nullptr;
    bool isLeaf = false; // then it has at most kMaxLeafTriangles references
};

// Which subtrees become children of a wide node, one to kBvhWidth, so that the tree is the cheapest.
[[nodiscard]] std::vector<WideChild> wideChildren(const BuildNode& node);

// Collapses to kBvhWidth children a node, quantises, and lays nodes and leaf triangles out depth first; fills
// nodes, leafTriangles and levels. `root` may be null: no triangles. Throws Error if the result exceeds
// requireBvhFits.
[[nodiscard]] Bvh flattenTree(const BuildNode* root);

} // namespace lavalight
