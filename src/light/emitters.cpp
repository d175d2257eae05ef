// Collects emissive triangles.
#include "light/emitters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "light/texture_mean.h"

namespace lavalight {

namespace {

double triangleArea(const Mesh& mesh, const glm::uvec3& triangle) {
    const glm::dvec3 v0(mesh.positions[triangle.x]);
    const glm::dvec3 v1(mesh.positions[triangle.y]);
    const glm::dvec3 v2(mesh.positions[triangle.z]);
    return 0.5 * glm::length(glm::cross(v1 - v0, v2 - v0));
}

// Means of textures by material and slot; meshes share them.
using TextureMeans = std::map<std::pair<uint32_t, TextureSlot>, TextureMean>;

// A texture of a mesh's material as its triangles show it; white where there is none.
class ShownTexture {
  public:
    ShownTexture() = default;
    ShownTexture(const Scene& scene, const Mesh& mesh, TextureSlot slot, TextureMeans& means) {
        const std::optional<Texture>& texture = scene.materials[mesh.material].texture(slot);
        if (!texture)
            return;
        texels_ = &means.try_emplace({mesh.material, slot}, scene.pictures[texture->picture], *texture)
                       .first->second;
        if (texture->uvSet < mesh.uvs.size())
            uvs_ = mesh.uvs[texture->uvSet];
    }

    [[nodiscard]] glm::dvec3 over(const glm::uvec3& triangle) const {
        return texels_ != nullptr ? texels_->over(corners(triangle)) : glm::dvec3(1.0);
    }

  private:
    [[nodiscard]] std::array<glm::vec2, 3> corners(const glm::uvec3& triangle) const {
        if (uvs_.empty())
            return {};
        return {uvs_[triangle.x], uvs_[triangle.y], uvs_[triangle.z]};
    }

    const TextureMean* texels_ = nullptr;
    std::span<const glm::vec2> uvs_;
};

// What a mesh's triangles emit.
class Exitance {
  public:
    Exitance(const Scene& scene, const Mesh& mesh, TextureMeans& means)
        : material_(&scene.materials[mesh.material]) {
        if (!emits())
            return;
        emission_ = ShownTexture(scene, mesh, TextureSlot::emission, means);
        if (material_->clearcoat > 0.0f)
            coat_ = ShownTexture(scene, mesh, TextureSlot::clearcoat, means);
    }

    [[nodiscard]] bool emits() const { return !material_->isUnlit && material_->emission != glm::vec3(0.0f); }

    // Exitance in W/m^2: radiance times pi, the integral of the cosine over the hemisphere, per emitting
    // side. The mean of the channels rather than their luminance, since a blue light is as noisy as a green
    // one where it is seen alone.
    [[nodiscard]] double of(const glm::uvec3& triangle) const {
        const double mean =
            glm::dot(glm::dvec3(material_->emission), emission_.over(triangle)) / 3.0 * throughCoat(triangle);
        return mean * std::numbers::pi * (material_->doubleSided ? 2.0 : 1.0);
    }

  private:
    // Share of the emission that leaves a coat (KHR_materials_clearcoat, "Emission") around the triangle's
    // own normal. A textured coat counts by its mean, as if it did not depend on where the emission is.
    [[nodiscard]] double throughCoat(const glm::uvec3& triangle) const {
        if (material_->clearcoat == 0.0f)
            return 1.0;
        // Schlick's reflectance averaged over the hemisphere by the cosine: 2 x (1 - x)^5 integrates to 1
        // / 21.
        constexpr double kMeanReflectance = 0.04 + 0.96 / 21.0;
        return 1.0 - material_->clearcoat * coat_.over(triangle).r * kMeanReflectance;
    }

    const Material* material_;
    ShownTexture emission_;
    ShownTexture coat_;
};

// What a triangle of an emitting mesh is as a light.
struct Emission {
    double area = 0.0;
    double power = 0.0;
};

// What each triangle of the mesh emits, found on all processors: a textured one takes the mean of its texels.
std::vector<Emission> emissionsOf(const Mesh& mesh, const Exitance& exitance) {
    constexpr size_t kAtATime = 256;
    const size_t count = mesh.triangles.size();
    std::vector<Emission> emissions(count);
    forEachInParallel((count + kAtATime - 1) / kAtATime, [&](size_t part) {
        for (size_t i = part * kAtATime; i < std::min(count, (part + 1) * kAtATime); ++i) {
            const double area = triangleArea(mesh, mesh.triangles[i]);
            emissions[i] = {area, area * exitance.of(mesh.triangles[i])};
        }
    });
    return emissions;
}

// Fills list and emitterOfTriangle.
void collect(const Scene& scene, const Mesh& mesh, TextureMeans& means, Emitters& emitters) {
    const auto first = static_cast<uint32_t>(emitters.emitterOfTriangle.size());
    emitters.emitterOfTriangle.resize(first + mesh.triangles.size(), kNoEmitter);
    const Exitance exitance(scene, mesh, means);
    if (!exitance.emits())
        return;
    uint32_t id = first;
    for (const auto& [area, power] : emissionsOf(mesh, exitance)) {
        if (!std::isfinite(power))
            throw Error(
                fmt::format("cannot use material '{}' as a light: triangle {} of mesh '{}' emits {} W",
                            scene.materials[mesh.material].name, id, mesh.name, power));
        if (static_cast<float>(area) > 0.0f && power > 0.0) {
            emitters.emitterOfTriangle[id] = static_cast<uint32_t>(emitters.list.size());
            emitters.list.push_back({id, static_cast<float>(area), power});
        }
        ++id;
    }
}

} // namespace

Emitters findEmitters(const Scene& scene) {
    Emitters emitters;
    TextureMeans means;
    emitters.emitterOfTriangle.reserve(scene.triangleCount());
    for (const Mesh& mesh : scene.meshes)
        collect(scene, mesh, means, emitters);
    return emitters;
}

} // namespace lavalight
