// Collects emissive triangles.
#include "light/emitters.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>

#include "base/error.h"
#include "base/log.h"
#include "light/texture_mean.h"

namespace lavalight {

namespace {

double triangleArea(const Mesh& mesh, const glm::uvec3& triangle) {
    const glm::dvec3 v0(mesh.positions[triangle.x]);
    const glm::dvec3 v1(mesh.positions[triangle.y]);
    const glm::dvec3 v2(mesh.positions[triangle.z]);
    return 0.5 * glm::length(glm::cross(v1 - v0, v2 - v0));
}

// Means of the emission textures by material; meshes share them.
using TextureMeans = std::map<uint32_t, TextureMean>;

// What a mesh's triangles emit.
class Exitance {
  public:
    Exitance(const Scene& scene, const Mesh& mesh, TextureMeans& means)
        : material_(&scene.materials[mesh.material]) {
        const std::optional<Texture>& texture = material_->texture(TextureSlot::emission);
        if (!emits() || !texture)
            return;
        texels_ = &means.try_emplace(mesh.material, scene.pictures[texture->picture], *texture).first->second;
        if (texture->uvSet < mesh.uvs.size())
            uvs_ = mesh.uvs[texture->uvSet];
    }

    [[nodiscard]] bool emits() const { return !material_->isUnlit && material_->emission != glm::vec3(0.0f); }

    // Exitance in W/m^2: radiance times pi, the integral of the cosine over the hemisphere, per emitting
    // side. The mean of the channels rather than their luminance, since a blue light is as noisy as a green
    // one where it is seen alone.
    [[nodiscard]] double of(const glm::uvec3& triangle) const {
        const glm::dvec3 texture = texels_ != nullptr ? texels_->over(corners(triangle)) : glm::dvec3(1.0);
        const double mean = glm::dot(glm::dvec3(material_->emission), texture) / 3.0;
        return mean * std::numbers::pi * (material_->doubleSided ? 2.0 : 1.0);
    }

  private:
    [[nodiscard]] std::array<glm::vec2, 3> corners(const glm::uvec3& triangle) const {
        if (uvs_.empty())
            return {};
        return {uvs_[triangle.x], uvs_[triangle.y], uvs_[triangle.z]};
    }

    const Material* material_;
    const TextureMean* texels_ = nullptr;
    std::span<const glm::vec2> uvs_;
};

// Fills list and emitterOfTriangle.
void collect(const Scene& scene, const Mesh& mesh, TextureMeans& means, Emitters& emitters) {
    const Exitance exitance(scene, mesh, means);
    for (const glm::uvec3& triangle : mesh.triangles) {
        const auto id = static_cast<uint32_t>(emitters.emitterOfTriangle.size());
        emitters.emitterOfTriangle.push_back(kNoEmitter);
        if (!exitance.emits())
            continue;
        const double area = triangleArea(mesh, triangle);
        const double power = area * exitance.of(triangle);
        if (!std::isfinite(power))
            throw Error(
                fmt::format("cannot use material '{}' as a light: triangle {} of mesh '{}' emits {} W",
                            scene.materials[mesh.material].name, id, mesh.name, power));
        if (static_cast<float>(area) <= 0.0f || power <= 0.0)
            continue;
        emitters.emitterOfTriangle.back() = static_cast<uint32_t>(emitters.list.size());
        emitters.list.push_back({id, static_cast<float>(area), power});
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
