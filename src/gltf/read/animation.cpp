// Animations (glTF 2.0 specification, section 3.11).
#include "gltf/read/animation.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/named.h"
#include "gltf/decode/accessor.h"
#include "gltf/read/keyframes.h"

namespace lavalight {
namespace {

// Keys may be broken in an animation that nobody asked for: only what is plain counts.
float lastKey(const GltfDocument& document, JsonView animation) {
    float last = 0.0f;
    for (const JsonView sampler : animation["samplers"].elements()) {
        const AccessorView times(document, sampler.count("input", 0));
        if (times.isScalar() && times.count() > 0)
            last = std::max(last, times.scalarAt(times.count() - 1));
    }
    return last;
}

// The first, unless another is wanted.
size_t findAnimation(const GltfDocument& document, const std::string& wanted) {
    const std::string source = printable(document.source);
    if (document.list("animations").size() == 0)
        throw UsageError(fmt::format("{} has no animation that a time could be asked of", source));
    if (wanted.empty())
        return 0;
    std::vector<std::string> names;
    for (const JsonView animation : document.list("animations").elements())
        names.push_back(printable(animation.text("name")));
    return findNamed(names, {wanted, "--animation", "animation", source});
}

void applyChannel(const Keyframes& keys, const std::string& path, double seconds, NodePose& node) {
    if (path == "translation") {
        node.translation = glm::dvec3(keys.at(seconds, 0));
    } else if (path == "rotation") {
        node.rotation = keys.at(seconds, 0);
    } else if (path == "scale") {
        node.scale = glm::dvec3(keys.at(seconds, 0));
    } else {
        node.weights.clear();
        for (size_t lane = 0; lane < keys.lanes(); ++lane)
            node.weights.push_back(keys.at(seconds, lane).x);
    }
}

std::optional<KeyType> typeOfPath(const std::string& path) {
    if (path == "translation" || path == "scale")
        return KeyType{path, 3};
    if (path == "rotation")
        return KeyType{.name = path, .components = 4, .isRotation = true};
    if (path == "weights")
        return KeyType{.name = path, .isArray = true};
    return std::nullopt;
}

} // namespace

JsonView AnimationChannels::samplerOf(const GltfDocument& document, JsonView channel) const {
    const size_t number = channel.count("sampler", 0);
    if (number >= samplers.size())
        throw document.error(
            fmt::format("{} has {} samplers, but a channel uses number {}", name, samplers.size(), number));
    return samplers[number];
}

AnimationChannels findChannels(const GltfDocument& document, const std::string& wanted) {
    const size_t index = findAnimation(document, wanted);
    const JsonView animation = document.list("animations")[index];
    return {describe("animation", index, animation.text("name")), animation["channels"],
            animation["samplers"]};
}

std::vector<Animation> listAnimations(const GltfDocument& document) {
    std::vector<Animation> animations;
    for (const JsonView animation : document.list("animations").elements())
        animations.push_back({printable(animation.text("name")), lastKey(document, animation)});
    return animations;
}

Pose poseAt(const GltfDocument& document, const ImportOptions& options) {
    if (!options.seconds)
        return {};
    const AnimationChannels channels = findChannels(document, options.animation);
    Pose pose(document.list("nodes").size());
    KeyTimes times(document);
    for (const JsonView channel : channels.all.elements()) {
        const std::optional<KeyType> type = typeOfPath(channel["target"].text("path"));
        const std::optional<size_t> node = channel["target"].index("node");
        if (!node || !type)
            continue; // extensions have such channels: animation_pointer.h
        const Keyframes keys(document, channels.samplerOf(document, channel), *type, times);
        applyChannel(keys, type->name, *options.seconds, pose.at(*node));
    }
    return pose;
}

} // namespace lavalight
