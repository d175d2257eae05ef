#include "accel/z_curve_tree.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace lavalight {
namespace {

// Every third bit of the result is one of the ten of x.
uint32_t spread(uint32_t x) {
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

// Numbers of the triangles, along the curve.
std::vector<uint32_t> alongZCurve(std::span<const Triangle> triangles) {
    const auto middle = [](const Triangle& t) { return (t.v0 + t.v1 + t.v2) / 3.0f; };
    glm::vec3 lower(std::numeric_limits<float>::infinity());
    glm::vec3 upper = -lower;
    for (const Triangle& t : triangles) {
        lower = glm::min(lower, middle(t));
        upper = glm::max(upper, middle(t));
    }
    const glm::vec3 scale = 1023.0f / glm::max(upper - lower, glm::vec3(1e-30f));
    std::vector<std::pair<uint32_t, uint32_t>> keys;
    keys.reserve(triangles.size());
    for (uint32_t id = 0; id < triangles.size(); ++id) {
        const glm::uvec3 cell((middle(triangles[id]) - lower) * scale);
        keys.emplace_back(spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2, id);
    }
    std::ranges::sort(keys);
    std::vector<uint32_t> ids;
    ids.reserve(keys.size());
    for (const auto& [key, id] : keys)
        ids.push_back(id);
    return ids;
}

Box boxOf(const Triangle& t) {
    return {glm::min(glm::min(t.v0, t.v1), t.v2), glm::max(glm::max(t.v0, t.v1), t.v2)};
}

Box boxAround(std::span<const Box> boxes) {
    Box around = boxes.front();
    for (const Box& box : boxes) {
        around.lower = glm::min(around.lower, box.lower);
        around.upper = glm::max(around.upper, box.upper);
    }
    return around;
}

} // namespace

// Children that are missing have boxes that meet nothing.
ZCurveTree::Node ZCurveTree::nodeOf(std::span<const Box> children) {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN(); // no comparison with it is true
    Node node{};
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (size_t i = 0; i < kChildren; ++i) {
            const bool isThere = i < children.size();
            node.lower[static_cast<size_t>(axis)][i] = isThere ? children[i].lower[axis] : kNone;
            node.upper[static_cast<size_t>(axis)][i] = isThere ? children[i].upper[axis] : kNone;
        }
    return node;
}

ZCurveTree::ZCurveTree(std::span<const Triangle> triangles) : ids_(alongZCurve(triangles)) {
    triangles_.reserve(ids_.size());
    std::vector<Box> boxes;
    boxes.reserve(ids_.size());
    for (const uint32_t id : ids_) {
        triangles_.push_back(triangles[id]);
        boxes.push_back(boxOf(triangles[id]));
    }
    bool isDone = boxes.empty();
    while (!isDone) {
        std::vector<Node>& level = levels_.emplace_back();
        std::vector<Box> around;
        for (size_t first = 0; first < boxes.size(); first += kChildren) {
            const auto children =
                std::span<const Box>(boxes).subspan(first, std::min(kChildren, boxes.size() - first));
            level.push_back(nodeOf(children));
            around.push_back(boxAround(children));
        }
        boxes = std::move(around);
        isDone = boxes.size() == 1;
    }
}

} // namespace lavalight
