// Animations: what they are, and the pose of all nodes at one time.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "gltf/file/document.h"
#include "gltf/import_options.h"
#include "scene/scene.h"

namespace lavalight {

// What an animation sets of one node; the rest is as the file has it.
struct NodePose {
    std::optional<glm::dvec3> translation;
    std::optional<glm::dvec4> rotation; // quaternion x, y, z, w
    std::optional<glm::dvec3> scale;
    std::vector<double> weights; // weights of the morph targets; empty: not animated
};
using Pose = std::vector<NodePose>; // by node; empty: nothing is animated

// The channels of one animation, and what they take their keys from. The document must outlive it.
struct AnimationChannels {
    std::string name; // for messages
    JsonView all;
    JsonView samplers;

    // Throws Error for a channel whose sampler the animation does not have.
    [[nodiscard]] JsonView samplerOf(const GltfDocument& document, JsonView channel) const;
};

// The animation of that name or number; the first where `wanted` is empty. Throws UsageError, listing the
// names, for one that the file does not have.
[[nodiscard]] AnimationChannels findChannels(const GltfDocument& document, const std::string& wanted);

// The animations of a file, in its order, with the time of their last key.
[[nodiscard]] std::vector<Animation> listAnimations(const GltfDocument& document);

// The pose at options.seconds; before the first and after the last key of a channel, that key holds. Without
// a time nothing is animated. Throws as findChannels does, and Error for keys that are no animation.
[[nodiscard]] Pose poseAt(const GltfDocument& document, const ImportOptions& options);

} // namespace lavalight
