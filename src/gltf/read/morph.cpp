// Morph targets (glTF 2.0 specification, section 3.7.2.2).
#include "gltf/read/morph.h"

#include <algorithm>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "gltf/decode/accessor.h"

namespace lavalight {
namespace {

// Adds one attribute of one target; tangents have four components, of which a target moves three.
template <class Vector, class Delta>
class Morph {
  public:
    Morph(const GltfDocument& document, const std::vector<uint32_t>& vertices,
          bool (AccessorView::*isRight)() const, Delta (AccessorView::*at)(size_t) const)
        : document_(document), vertices_(vertices), isRight_(isRight), at_(at) {}

    void add(JsonView target, const std::string& attribute, double weight,
             std::vector<Vector>& values) const {
        const std::optional<size_t> accessor = target.index(attribute);
        if (!accessor || values.empty())
            return;
        const AccessorView view(document_, *accessor);
        if (!(view.*isRight_)())
            throw document_.error(fmt::format("{} is used as {} of a morph target and must be a VEC{}",
                                              view.name(), attribute, Delta::length()));
        for (size_t i = 0; i < values.size(); ++i) {
            if (vertices_[i] >= view.count())
                throw document_.error(fmt::format("{} is used as {} of a morph target and has {} elements, "
                                                  "too few for vertex {}",
                                                  view.name(), attribute, view.count(), vertices_[i]));
            const Delta delta = static_cast<float>(weight) * (view.*at_)(vertices_[i]);
            for (glm::length_t axis = 0; axis < Delta::length(); ++axis)
                values[i][axis] += delta[axis];
        }
    }

  private:
    const GltfDocument& document_;
    const std::vector<uint32_t>& vertices_;
    bool (AccessorView::*isRight_)() const;
    Delta (AccessorView::*at_)(size_t) const;
};

void addColors(const GltfDocument& document, const std::vector<uint32_t>& vertices, JsonView target,
               double weight, std::vector<glm::vec4>& colors) {
    const std::optional<size_t> accessor = target.index("COLOR_0");
    if (!accessor)
        return;
    if (AccessorView(document, *accessor).isVec3())
        Morph<glm::vec4, glm::vec3>(document, vertices, &AccessorView::isVec3, &AccessorView::vec3At)
            .add(target, "COLOR_0", weight, colors);
    else
        Morph<glm::vec4, glm::vec4>(document, vertices, &AccessorView::isVec4, &AccessorView::vec4At)
            .add(target, "COLOR_0", weight, colors);
}

} // namespace

std::vector<double> morphWeights(const GltfDocument& document, size_t node, const Pose& pose, size_t most) {
    std::vector<double> weights;
    if (node < pose.size() && !pose[node].weights.empty()) {
        weights = pose[node].weights;
        weights.resize(std::min(weights.size(), most));
        return weights;
    }
    const JsonView source = document.list("nodes")[node];
    const bool hasOwn = source["weights"].size() > 0;
    const JsonView stored = (hasOwn ? source : document.list("meshes")[source.count("mesh", 0)])["weights"];
    for (size_t i = 0; i < std::min(stored.size(), most); ++i)
        weights.push_back(stored[i].asNumber(0.0));
    return weights;
}

double morphSteps(JsonView primitive, double vertices, const std::vector<double>& weights) {
    const JsonView targets = primitive["targets"];
    const size_t count = std::min(targets.size(), weights.size());
    auto steps = static_cast<double>(count);
    for (size_t i = 0; i < count; ++i) {
        if (weights[i] != 0.0)
            steps += vertices * static_cast<double>(targets[i].members().size());
    }
    return steps;
}

void applyMorphTargets(const GltfDocument& document, JsonView primitive,
                       const std::vector<uint32_t>& vertices, const std::vector<double>& weights,
                       Mesh& mesh) {
    const Morph<glm::vec3, glm::vec3> vec3s(document, vertices, &AccessorView::isVec3, &AccessorView::vec3At);
    const Morph<glm::vec4, glm::vec3> tangents(document, vertices, &AccessorView::isVec3,
                                               &AccessorView::vec3At);
    const Morph<glm::vec2, glm::vec2> vec2s(document, vertices, &AccessorView::isVec2, &AccessorView::vec2At);
    const JsonView targets = primitive["targets"];
    for (size_t i = 0; i < std::min(targets.size(), weights.size()); ++i) {
        const JsonView target = targets[i];
        const double weight = weights[i];
        if (weight == 0.0)
            continue;
        vec3s.add(target, "POSITION", weight, mesh.positions);
        vec3s.add(target, "NORMAL", weight, mesh.normals);
        tangents.add(target, "TANGENT", weight, mesh.tangents);
        for (size_t set = 0; set < mesh.uvs.size(); ++set)
            vec2s.add(target, fmt::format("TEXCOORD_{}", set), weight, mesh.uvs[set]);
        addColors(document, vertices, target, weight, mesh.colors);
    }
}

} // namespace lavalight
