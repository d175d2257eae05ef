// Node transforms and hierarchy (glTF 2.0 specification, sections 3.5.2 and 3.5.3); loops instead of
// recursion, because files may nest nodes deeper than the stack.
#include "gltf/read/nodes.h"

#include <fmt/format.h>

#include "base/named.h"
#include "gltf/read/transform.h"

namespace lavalight {
namespace {

std::string nameOf(const GltfDocument& document, size_t node) {
    return describe("node", node, document.list("nodes")[node].text("name"));
}

constexpr size_t kNoNode = static_cast<size_t>(-1);

std::vector<size_t> numbersIn(JsonView array) {
    std::vector<size_t> numbers;
    for (const JsonView number : array.elements())
        numbers.push_back(number.asCount(0));
    return numbers;
}

// The parent of each node, kNoNode for roots.
std::vector<size_t> findParents(const GltfDocument& document) {
    const JsonView nodes = document.list("nodes");
    std::vector<size_t> parents(nodes.size(), kNoNode);
    for (size_t i = 0; i < nodes.size(); ++i) {
        for (const size_t child : numbersIn(nodes[i]["children"])) {
            if (parents[child] != kNoNode)
                throw document.error(fmt::format("{} is a child of both node {} and node {}",
                                                 nameOf(document, child), parents[child], i));
            parents[child] = i;
        }
    }
    return parents;
}

// With one parent each, nodes form trees and rings. Climbs from each node; each is passed once.
void requireNoCycle(const GltfDocument& document, const std::vector<size_t>& parents) {
    std::vector<size_t> climb(parents.size(), kNoNode); // the start of the climb that came by
    for (size_t start = 0; start < parents.size(); ++start) {
        for (size_t node = start; node != kNoNode; node = parents[node]) {
            size_t& seen = climb[node];
            if (seen == start)
                throw document.error(nameOf(document, node) +
                                     " is among its own descendants: the node graph is cyclic");
            if (seen != kNoNode)
                break;
            seen = start;
        }
    }
}

std::vector<size_t> findRoots(const GltfDocument& document, const std::vector<size_t>& parents) {
    const JsonView scenes = document.list("scenes");
    if (scenes.size() > 0) {
        const size_t scene = document.scene;
        std::vector<size_t> listed = numbersIn(scenes[scene]["nodes"]);
        for (const size_t node : listed) {
            if (parents[node] != kNoNode)
                throw document.error(fmt::format("scene {} lists {}, which is a child of node {}", scene,
                                                 nameOf(document, node), parents[node]));
        }
        return listed;
    }
    std::vector<size_t> roots;
    for (size_t i = 0; i < parents.size(); ++i) {
        if (parents[i] == kNoNode)
            roots.push_back(i);
    }
    return roots;
}

glm::dmat4 localTransform(JsonView node, const NodePose& pose) {
    const JsonView stored = node["matrix"];
    if (stored && !pose.translation && !pose.rotation && !pose.scale) {
        glm::dmat4 matrix;
        for (glm::length_t i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = stored[static_cast<size_t>(i)].asNumber(0.0);
        return matrix;
    }
    Transform transform;
    if (!stored) { // a node has either
        transform.translation = node.vector<3>("translation", transform.translation);
        transform.rotation = node.vector<4>("rotation", transform.rotation);
        transform.scale = node.vector<3>("scale", transform.scale);
    }
    transform.translation = pose.translation.value_or(transform.translation);
    transform.rotation = pose.rotation.value_or(transform.rotation);
    transform.scale = pose.scale.value_or(transform.scale);
    return transform.matrix();
}

// The transforms of all nodes, from each root down.
std::vector<glm::dmat4> worldTransforms(const GltfDocument& document, const std::vector<size_t>& parents,
                                        const Pose& pose) {
    const JsonView nodes = document.list("nodes");
    std::vector<glm::dmat4> toWorld(nodes.size(), glm::dmat4(1.0));
    std::vector<size_t> pending;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (parents[i] == kNoNode)
            pending.push_back(i);
    }
    while (!pending.empty()) {
        const size_t index = pending.back();
        pending.pop_back();
        if (parents[index] != kNoNode)
            toWorld[index] = toWorld[parents[index]];
        toWorld[index] *= localTransform(nodes[index], pose.empty() ? NodePose{} : pose[index]);
        for (const size_t child : numbersIn(nodes[index]["children"]))
            pending.push_back(child);
    }
    return toWorld;
}

// KHR_node_visibility.
bool isHidden(JsonView node) {
    return !node["extensions"]["KHR_node_visibility"].flag("visible", true);
}

} // namespace

void chooseScene(GltfDocument& document, const std::string& wanted) {
    for (const JsonView scene : document.list("scenes").elements())
        document.scenes.push_back(printable(scene.text("name")));
    document.scene = wanted.empty()
                         ? JsonView(document.json).count("scene", 0)
                         : findNamed(document.scenes, {wanted, "--scene", "scene", document.source});
}

void NodeTree::moveOrigin(const glm::dvec3& origin) {
    const glm::dvec4 way(origin, 0.0);
    for (PlacedNode& placed : shown)
        placed.toWorld[3] -= way;
    for (glm::dmat4& transform : toWorld)
        transform[3] -= way;
}

NodeTree placeNodes(const GltfDocument& document, Pose pose) {
    const std::vector<size_t> parents = findParents(document);
    requireNoCycle(document, parents);
    NodeTree tree;
    tree.toWorld = worldTransforms(document, parents, pose);
    tree.pose = std::move(pose);
    std::vector<bool> seen(parents.size(), false);
    std::vector<PlacedNode> pending;
    const auto add = [&](size_t node, bool isVisible) {
        pending.push_back({node, tree.toWorld[node], isVisible});
    };
    const std::vector<size_t> roots = findRoots(document, parents);
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        add(*root, true);
    while (!pending.empty()) {
        PlacedNode next = pending.back();
        pending.pop_back();
        if (seen[next.node])
            throw document.error(nameOf(document, next.node) + " is listed twice by the scene");
        seen[next.node] = true;
        const JsonView node = document.list("nodes")[next.node];
        next.isVisible = next.isVisible && !isHidden(node);
        const std::vector<size_t> children = numbersIn(node["children"]);
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            add(*child, next.isVisible);
        tree.shown.push_back(next);
    }
    return tree;
}

} // namespace lavalight
