// Linear blend skinning (glTF 2.0 specification, section 3.7.3).
#include "gltf/read/skin.h"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "gltf/decode/accessor.h"
#include "scene/mesh_bake.h"

namespace lavalight {
namespace {

// Adds up each vertex's joints by their weights.
class Blend {
  public:
    Blend(const GltfDocument& document, const std::vector<uint32_t>& vertices,
          const std::vector<glm::dmat4>& joints)
        : document_(document), vertices_(vertices), joints_(joints),
          transforms_(vertices.size(), glm::dmat4(0.0)), sums_(vertices.size(), 0.0) {}

    // Four joints a vertex, and their weights.
    void add(const AccessorView& joints, const AccessorView& weights) {
        if (!joints.isUnsignedVec4() || !weights.isVec4())
            throw document_.error(
                fmt::format("{} and {} are used as joints and weights: they must be VEC4s, the "
                            "first of an unsigned type",
                            joints.name(), weights.name()));
        for (size_t i = 0; i < vertices_.size(); ++i) {
            const glm::vec4 numbers = joints.vec4At(vertices_[i]);
            const glm::vec4 parts = weights.vec4At(vertices_[i]);
            for (int k = 0; k < 4; ++k) {
                if (parts[k] > 0.0f && std::isfinite(parts[k]))
                    addJoint(i, numbers[k], parts[k], joints.name());
            }
        }
    }

    // Weights should add up to 1; quantized ones do so nearly. Vertices that no joint moves follow the first.
    [[nodiscard]] glm::dmat4 transform(size_t i) const {
        return sums_[i] > 0.0 ? transforms_[i] / sums_[i] : joints_.front();
    }

  private:
    void addJoint(size_t vertex, float number, double weight, const std::string& accessor) {
        if (!(number < static_cast<float>(joints_.size())))
            throw document_.error(
                fmt::format("{} names joint {} of a skin that has {}", accessor, number, joints_.size()));
        transforms_[vertex] += weight * joints_[static_cast<size_t>(number)];
        sums_[vertex] += weight;
    }

    const GltfDocument& document_;
    const std::vector<uint32_t>& vertices_;
    const std::vector<glm::dmat4>& joints_;
    std::vector<glm::dmat4> transforms_;
    std::vector<double> sums_;
};

} // namespace

std::vector<glm::dmat4> jointTransforms(const GltfDocument& document, size_t skin,
                                        const std::vector<glm::dmat4>& toWorld) {
    const JsonView source = document.list("skins")[skin];
    const std::string name = describe("skin", skin, source.text("name"));
    std::vector<glm::dmat4> transforms;
    for (const JsonView joint : source["joints"].elements())
        transforms.push_back(toWorld.at(joint.asCount(0)));
    if (transforms.empty())
        throw document.error(name + " has no joints");
    const std::optional<size_t> accessor = source.index("inverseBindMatrices");
    if (!accessor)
        return transforms;
    const AccessorView matrices(document, *accessor);
    if (!matrices.isFloatMat4() || matrices.count() < transforms.size())
        throw document.error(fmt::format("{} needs {} MAT4s of floats for its joints, {} does not hold them",
                                         name, transforms.size(), matrices.name()));
    for (size_t i = 0; i < transforms.size(); ++i)
        transforms[i] *= glm::dmat4(matrices.mat4At(i));
    return transforms;
}

bool hasJoints(JsonView primitive) {
    return primitive["attributes"].has("JOINTS_0") && primitive["attributes"].has("WEIGHTS_0");
}

void applySkin(const GltfDocument& document, const VertexSource& source,
               const std::vector<glm::dmat4>& joints, Mesh& mesh, VertexRuns& runs) {
    Blend blend(document, source.vertices, joints);
    const JsonView attributes = source.primitive["attributes"];
    for (size_t set = 0;; ++set) {
        const std::optional<size_t> numbers = attributes.index(fmt::format("JOINTS_{}", set));
        const std::optional<size_t> weights = attributes.index(fmt::format("WEIGHTS_{}", set));
        if (!numbers || !weights)
            break;
        blend.add(AccessorView(document, *numbers), AccessorView(document, *weights));
    }
    std::vector<bool> isMirrored(source.vertices.size(), false);
    for (size_t i = 0; i < source.vertices.size(); ++i) {
        const VertexTransform transform(glm::translate(blend.transform(i), source.anchor));
        runs.add(transform.apply(mesh, i));
        isMirrored[i] = transform.isMirrored();
    }
    for (glm::uvec3& triangle : mesh.triangles) {
        if (isMirrored[triangle.x])
            std::swap(triangle.y, triangle.z);
    }
}

} // namespace lavalight
