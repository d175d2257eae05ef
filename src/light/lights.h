// All lights of a scene in one distribution: emissive triangles, punctual lights, the environment.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "light/alias_table.h"
#include "light/emitters.h"
#include "scene/scene.h"

namespace lavalight {

enum class LightSelection : uint32_t {
    power,  // a light is picked with a probability proportional to its power
    uniform // every light alike
};

// Lights are numbered emitters first, then punctual lights, then the environment. Lights without power are
// left out.
struct Lights {
    Emitters emitters;
    std::vector<uint32_t> punctuals;     // indices into Scene::punctualLights
    std::optional<uint32_t> environment; // number of the environment light
    std::vector<double> powers;          // W, per light
    std::vector<AliasEntry> table;       // per light; its pmf serves sampling and MIS alike
};

// `environment`: constant radiance from all sides. Throws Error, naming the light, for a power that is not
// finite.
[[nodiscard]] Lights collectLights(const Scene& scene, const glm::vec3& environment,
                                   LightSelection selection);

// W, mean of the channels. Directional lights and the environment shine through the sphere around the scene.
[[nodiscard]] double powerOf(const PunctualLight& light, const Bounds& bounds);
[[nodiscard]] double environmentPower(const glm::vec3& radiance, const Bounds& bounds);

} // namespace lavalight
