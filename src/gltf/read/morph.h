// Morph targets.
#pragma once

#include <cstdint>
#include <vector>

#include "gltf/file/document.h"
#include "gltf/read/animation.h"
#include "scene/scene.h"

namespace lavalight {

// The weights of a node's mesh for the first `most` targets: those of the pose, else the node's own, else the
// mesh's. May be fewer, or empty.
[[nodiscard]] std::vector<double> morphWeights(const GltfDocument& document, size_t node, const Pose& pose,
                                               size_t most);

// What applyMorphTargets would do for a primitive of so many vertices: values added, and targets passed by.
[[nodiscard]] double morphSteps(JsonView primitive, double vertices, const std::vector<double>& weights);

// Adds the primitive's targets by their weights to `mesh`, whose vertices are those of these numbers.
// Attributes that the mesh lacks stay away, as do targets without a weight. Throws Error for targets of
// another type or number than the vertices.
void applyMorphTargets(const GltfDocument& document, JsonView primitive,
                       const std::vector<uint32_t>& vertices, const std::vector<double>& weights, Mesh& mesh);

} // namespace lavalight
