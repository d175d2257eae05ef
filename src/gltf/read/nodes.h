// Walks the node hierarchy of a glTF scene.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "gltf/file/document.h"
#include "gltf/read/animation.h"

namespace lavalight {

// A node of the shown scene with its transform to world space.
struct PlacedNode {
    size_t node = 0;
    glm::dmat4 toWorld{1.0}; // double: deep hierarchies multiply many
    bool isVisible = true;   // whether mesh and light are shown; cameras are always there
};

// All nodes in one pose.
struct NodeTree {
    std::vector<PlacedNode> shown;   // parents before children
    std::vector<glm::dmat4> toWorld; // transform of every node: joints may stand outside the scene
    Pose pose;
};

// `shown` holds the nodes of the default scene (of scene 0 where none is named, of all root nodes where there
// are no scenes). Throws Error unless the nodes form a forest: cycles, nodes with two parents.
[[nodiscard]] NodeTree placeNodes(const GltfDocument& document, Pose pose);

} // namespace lavalight
