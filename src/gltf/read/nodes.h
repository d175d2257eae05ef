// Walks the node hierarchy of a glTF scene.
#pragma once

#include <string>
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

    // Makes this place the one that coordinates count from.
    void moveOrigin(const glm::dvec3& origin);
};

// Lists the document's scenes and picks the one of that name or number; without, its default, or the first.
// Throws UsageError with the names that there are.
void chooseScene(GltfDocument& document, const std::string& wanted);

// `shown` holds the nodes of the document's chosen scene, or of all root nodes where there are no scenes.
// Throws Error unless the nodes form a forest: cycles, nodes with two parents.
[[nodiscard]] NodeTree placeNodes(const GltfDocument& document, Pose pose);

} // namespace lavalight
