// The builder of last resort: for inputs on which surface areas would make the tree too deep.
#include <algorithm>
#include <cassert>

#include "accel/build_tree.h"

namespace lavalight {

namespace {

// Twice the centre of the triangle's box.
glm::vec3 centre2(const Triangle& triangle) {
    const BuildBox box = triangleBox(triangle);
    return box.lower + box.upper;
}

int widestAxis(std::span<const Triangle> triangles, std::span<const uint32_t> ids) {
    BuildBox centres;
    for (const uint32_t id : ids)
        centres.extend({centre2(triangles[id]), centre2(triangles[id])});
    const glm::vec3 extent = centres.upper - centres.lower;
    return extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
}

} // namespace

BuildBox triangleBox(const Triangle& triangle) {
    return {glm::min(glm::min(triangle.v0, triangle.v1), triangle.v2),
            glm::max(glm::max(triangle.v0, triangle.v1), triangle.v2)};
}

const BuildNode* buildMedianTree(std::span<const Triangle> triangles, std::span<uint32_t> ids,
                                 float triangleCost, std::deque<BuildNode>& arena) {
    assert(!ids.empty());
    BuildNode& node = arena.emplace_back();
    if (ids.size() == 1) {
        makeReference(node, ids[0], triangleBox(triangles[ids[0]]), triangleCost);
        return &node;
    }
    const int axis = widestAxis(triangles, ids);
    const auto middle = ids.begin() + static_cast<std::ptrdiff_t>(ids.size() / 2);
    std::nth_element(ids.begin(), middle, ids.end(), [&](uint32_t a, uint32_t b) {
        const float ca = centre2(triangles[a])[axis];
        const float cb = centre2(triangles[b])[axis];
        return ca != cb ? ca < cb : a < b; // ids decide ties
    });
    const BuildNode* left = buildMedianTree(triangles, {ids.begin(), middle}, triangleCost, arena);
    const BuildNode* right = buildMedianTree(triangles, {middle, ids.end()}, triangleCost, arena);
    makeInner(node, *left, *right, triangleCost);
    return &node;
}

} // namespace lavalight
