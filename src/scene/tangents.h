// Tangents for meshes that come without them.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lavalight {

// The uv set along whose u a material wants tangents: that of its normal texture, else of the clearcoat's,
// else, where it is anisotropic, of the anisotropy texture or 0. None for other materials.
[[nodiscard]] std::optional<uint32_t> tangentUvSet(const Material& material);

// Some unit vector perpendicular to `normal`, which has unit length.
[[nodiscard]] glm::vec3 anyTangent(const glm::vec3& normal);

// Gives `mesh` tangents towards growing u of one uv set; without that set it stays as it is. Each corner
// counts by its angle, as MikkTSpace has it (Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008,
// chapter 5), which baked normal maps expect; corners are one vertex where position, normal and uv are equal.
// A vertex that triangles with mirrored and with plain uvs share becomes two, and a flat mesh gets three
// vertices of its own for each triangle. Where uvs have no area, tangents point anywhere along the surface.
void generateTangents(Mesh& mesh, uint32_t uvSet);

} // namespace lavalight
