// Node transforms and hierarchy (glTF 2.0 specification, sections 3.5.2 and 3.5.3); loops instead of
// recursion, because files may nest nodes deeper than the stack.
#include "gltf/read/nodes.h"

#include <algorithm>

#include <fmt/format.h>

#include "gltf/read/transform.h"

namespace lavalight {
namespace {

std::string nameOf(const GltfDocument& document, size_t node) {
    return describe("node", node, document.model.nodes[node].name);
}

// The parent of each node, -1 for roots.
std::vector<int> findParents(const GltfDocument& document) {
    const auto& nodes = document.model.nodes;
    std::vector<int> parents(nodes.size(), -1);
    for (size_t i = 0; i < nodes.size(); ++i) {
        for (const int child : nodes[i].children) {
            int& parent = parents[static_cast<size_t>(child)];
            if (parent >= 0)
                throw document.error(fmt::format("{} is a child of both node {} and node {}",
                                                 nameOf(document, static_cast<size_t>(child)), parent, i));
            parent = static_cast<int>(i);
        }
    }
    return parents;
}

// With one parent each, nodes form trees and rings. Climbs from each node; each is passed once.
void requireNoCycle(const GltfDocument& document, const std::vector<int>& parents) {
    constexpr size_t kUnseen = static_cast<size_t>(-1);
    std::vector<size_t> climb(parents.size(), kUnseen); // the start of the climb that came by
    for (size_t start = 0; start < parents.size(); ++start) {
        for (int node = static_cast<int>(start); node >= 0; node = parents[static_cast<size_t>(node)]) {
            size_t& seen = climb[static_cast<size_t>(node)];
            if (seen == start)
                throw document.error(nameOf(document, static_cast<size_t>(node)) +
                                     " is among its own descendants: the node graph is cyclic");
            if (seen != kUnseen)
                break;
            seen = start;
        }
    }
}

std::vector<int> findRoots(const GltfDocument& document, const std::vector<int>& parents) {
    const tinygltf::Model& model = document.model;
    if (!model.scenes.empty()) {
        const auto scene = static_cast<size_t>(std::max(model.defaultScene, 0));
        for (const int node : model.scenes.at(scene).nodes) {
            const int parent = parents[static_cast<size_t>(node)];
            if (parent >= 0)
                throw document.error(fmt::format("scene {} lists {}, which is a child of node {}", scene,
                                                 nameOf(document, static_cast<size_t>(node)), parent));
        }
        return model.scenes[scene].nodes;
    }
    std::vector<int> roots;
    for (size_t i = 0; i < parents.size(); ++i) {
        if (parents[i] < 0)
            roots.push_back(static_cast<int>(i));
    }
    return roots;
}

glm::dmat4 localTransform(const tinygltf::Node& node, const NodePose& pose) {
    if (node.matrix.size() == 16 && !pose.translation && !pose.rotation && !pose.scale) {
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
        return matrix;
    }
    Transform transform;
    if (node.translation.size() == 3)
        transform.translation = {node.translation[0], node.translation[1], node.translation[2]};
    if (node.rotation.size() == 4)
        transform.rotation = {node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]};
    if (node.scale.size() == 3)
        transform.scale = {node.scale[0], node.scale[1], node.scale[2]};
    transform.translation = pose.translation.value_or(transform.translation);
    transform.rotation = pose.rotation.value_or(transform.rotation);
    transform.scale = pose.scale.value_or(transform.scale);
    return transform.matrix();
}

// The transforms of all nodes, from each root down.
std::vector<glm::dmat4> worldTransforms(const GltfDocument& document, const std::vector<int>& parents,
                                        const Pose& pose) {
    const auto& nodes = document.model.nodes;
    std::vector<glm::dmat4> toWorld(nodes.size(), glm::dmat4(1.0));
    std::vector<size_t> pending;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (parents[i] < 0)
            pending.push_back(i);
    }
    while (!pending.empty()) {
        const size_t index = pending.back();
        pending.pop_back();
        if (parents[index] >= 0)
            toWorld[index] = toWorld[static_cast<size_t>(parents[index])];
        toWorld[index] *= localTransform(nodes[index], pose.empty() ? NodePose{} : pose[index]);
        for (const int child : nodes[index].children)
            pending.push_back(static_cast<size_t>(child));
    }
    return toWorld;
}

// KHR_node_visibility.
bool isHidden(const tinygltf::Node& node) {
    const auto extension = node.extensions.find("KHR_node_visibility");
    return extension != node.extensions.end() && extension->second.Has("visible") &&
           !extension->second.Get("visible").Get<bool>();
}

} // namespace

NodeTree placeNodes(const GltfDocument& document, Pose pose) {
    const std::vector<int> parents = findParents(document);
    requireNoCycle(document, parents);
    NodeTree tree;
    tree.toWorld = worldTransforms(document, parents, pose);
    tree.pose = std::move(pose);
    std::vector<bool> seen(parents.size(), false);
    std::vector<PlacedNode> pending;
    const auto add = [&](int node, bool isVisible) {
        pending.push_back({node, tree.toWorld[static_cast<size_t>(node)], isVisible});
    };
    const std::vector<int> roots = findRoots(document, parents);
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        add(*root, true);
    while (!pending.empty()) {
        PlacedNode next = pending.back();
        pending.pop_back();
        const auto index = static_cast<size_t>(next.node);
        if (seen[index])
            throw document.error(nameOf(document, index) + " is listed twice by the scene");
        seen[index] = true;
        const tinygltf::Node& node = document.model.nodes[index];
        next.isVisible = next.isVisible && !isHidden(node);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            add(*child, next.isVisible);
        tree.shown.push_back(next);
    }
    return tree;
}

} // namespace lavalight
