// All lights of a scene in one distribution: emissive triangles, punctual lights, the environment.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "light/alias_table.h"
#include "light/emitters.h"
#include "light/environment.h"
#include "light/light_tree.h"
#include "scene/scene.h"

namespace lavalight {

enum class LightSelection : uint32_t {
    automatic, // resolveLightSelection() says which
    power,     // a light is picked with a probability proportional to its power
    uniform,   // every light alike
    tree       // by what a light may bring to the point; the whole tree as often as one light at infinity
};

// Lights are numbered emitters first, then point lights and spots, directional lights, the environment.
// Lights without power are left out.
struct Lights {
    LightSelection selection = LightSelection::power; // as resolved
    Emitters emitters;
    std::vector<uint32_t> punctuals;     // indices into Scene::punctualLights, in that order
    std::optional<uint32_t> environment; // number of the environment light
    glm::vec3 environmentRadiance{0.0f}; // constant, or what the map's texels are multiplied by
    std::optional<EnvironmentDistribution> environmentMap; // distribution of the scene's map
    std::optional<SunDisc> sun;                            // of the map
    double sunShare = 0.0;      // probability that a sample of the environment is one of the sun
    std::vector<double> powers; // W, per light
    LightTree tree;             // tree over the lights before firstColumn; empty but for LightSelection::tree
    uint32_t firstColumn = 0;   // the first light of `table`
    // An entry per light from firstColumn on, and then one more for the tree, if there is one; pmf serves
    // sampling and MIS alike.
    std::vector<AliasEntry> table;
};

// What LightSelection::automatic stands for: the tree where there is more to choose from than the two halves
// of a quad. On scenes of many lights, of lights and sky, or of lights at different distances it takes 0.06
// to 0.6 of the time to equal error; in a box with one quad, 1.1.
[[nodiscard]] LightSelection resolveLightSelection(LightSelection selection, size_t localLights,
                                                   size_t allLights);

// `environment`: constant radiance from all sides, or what the texels of the scene's map are multiplied by.
// With `bsdfFindsEnvironment`, which is what MIS does, LightSelection::tree picks a constant environment less
// often than others. Throws Error, naming the light, for a power that is not finite.
[[nodiscard]] Lights collectLights(const Scene& scene, const glm::vec3& environment, LightSelection selection,
                                   bool bsdfFindsEnvironment = true);

// Power in W, mean of the channels; with a range, what of it gets as far as the scene is wide. Directional
// lights and the environment shine through the sphere around the scene.
[[nodiscard]] double powerOf(const PunctualLight& light, const Bounds& bounds);
[[nodiscard]] double environmentPower(const glm::vec3& radiance, const Bounds& bounds);

} // namespace lavalight
