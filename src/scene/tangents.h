// Tangents for meshes that come without them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lavalight {

// Coordinates along which tangents go: those of a uv set after the linear part of a texture's transform.
struct TangentSpace {
    uint32_t uvSet = 0;
    glm::vec2 uRow{1.0f, 0.0f}; // u = dot(uRow, uv), v alike
    glm::vec2 vRow{0.0f, 1.0f};
    bool operator==(const TangentSpace&) const = default;
};

// The spaces that a material wants, each once, and which of them its textures go by. The normal texture, and
// all that has no texture, go by the first.
struct TangentSpaces {
    std::vector<TangentSpace> spaces; // none: the material needs no tangents
    uint32_t coat = 0;                // index of the clearcoat's normal texture's
    uint32_t anisotropy = 0;          // of the anisotropy texture's
};

// Spaces of the normal texture, the clearcoat's, and, where the material is anisotropic, the anisotropy
// texture's or, if it is alone, uv set 0.
[[nodiscard]] TangentSpaces tangentSpaces(const Material& material);

// Some unit vector perpendicular to `normal`, which has unit length.
[[nodiscard]] glm::vec3 anyTangent(const glm::vec3& normal);

// Gives `mesh` tangents towards growing u of each space; a space whose uv set it lacks gets none. Each corner
// counts by its angle, as MikkTSpace has it (Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008,
// chapter 5), which baked normal maps expect; corners are one vertex where position, normal and uv are equal.
// A vertex that triangles with mirrored and with plain uvs share becomes two, and a flat mesh gets three
// vertices of its own for each triangle. Where uvs have no area, tangents point anywhere along the surface.
void generateTangents(Mesh& mesh, std::span<const TangentSpace> spaces);

} // namespace lavalight
