// Point, spot and directional lights (KHR_lights_punctual): they shine along -z of their node. Candela and
// lux are taken as W/sr and W/m^2.
#include "gltf/read/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "gltf/read/factors.h"

namespace lavalight {
namespace {

std::optional<PunctualKind> kindOf(const std::string& type) {
    if (type == "point")
        return PunctualKind::point;
    if (type == "spot")
        return PunctualKind::spot;
    if (type == "directional")
        return PunctualKind::directional;
    return std::nullopt;
}

// The node's scale leaves the light as it is. False where the node puts the light out of reach or squeezes
// its -z axis to nothing, and the light needs what is missing.
bool placeLight(const glm::dmat4& toWorld, PunctualLight& light) {
    const glm::dvec3 position(toWorld[3]);
    const glm::dvec3 forward = -glm::dvec3(toWorld[2]);
    const double length = glm::length(forward);
    const bool hasPlace = glm::all(glm::lessThanEqual(glm::abs(position), glm::dvec3(kLargestPosition)));
    const bool hasDirection = length > 0.0 && std::isfinite(length);
    if (hasPlace)
        light.position = glm::vec3(position);
    if (hasDirection)
        light.direction = glm::vec3(forward / length);
    return (hasPlace || light.kind == PunctualKind::directional) &&
           (hasDirection || light.kind == PunctualKind::point);
}

void readCone(JsonView spot, const std::string& name, PunctualLight& light, GltfNotes& notes) {
    constexpr double kQuarterTurn = std::numbers::pi / 2.0;
    const double innerAngle = spot.number("innerConeAngle", 0.0);
    const double outerAngle = spot.number("outerConeAngle", std::numbers::pi / 4.0);
    light.outerConeAngle = FactorReader(name, notes).clamped(outerAngle, 0.0, kQuarterTurn, "outerConeAngle");
    const double outer = std::clamp(outerAngle, 0.0, kQuarterTurn);
    if (innerAngle < 0.0 || innerAngle > outer)
        notes.addObject("innerConeAngle was clamped to 0 .. outerConeAngle", name);
    light.innerConeAngle = static_cast<float>(std::clamp(innerAngle, 0.0, outer));
}

// Directional lights have none, and nothing is beyond the reach of a light without one.
float readRange(JsonView source, const std::string& name, GltfNotes& notes) {
    if (!source.has("range"))
        return kNoRange;
    const double range = source.number("range", 0.0);
    if (range > 0.0)
        return static_cast<float>(std::min(range, double{kNoRange}));
    notes.addObject("ranges of lights that are not above 0 were left out", name);
    return kNoRange;
}

// What of a light does not depend on its node; nothing for an unknown type.
std::optional<PunctualLight> readLight(JsonView source, const std::string& name, GltfNotes& notes) {
    const std::optional<PunctualKind> kind = kindOf(source.text("type"));
    if (!kind) {
        notes.addObject("lights of an unknown type were left out", name);
        return std::nullopt;
    }
    FactorReader factors(name, notes);
    PunctualLight light;
    light.kind = *kind;
    light.intensity =
        glm::vec3(factors.clamped(source.number("intensity", 1.0), 0.0, kLargestFactor, "intensity"));
    if (source.has("color"))
        light.intensity *= factors.clamped(source.vector<3>("color", glm::dvec3(1.0)), 1.0, "color");
    if (light.kind == PunctualKind::spot)
        readCone(source["spot"], name, light, notes);
    if (light.kind != PunctualKind::directional)
        light.range = readRange(source, name, notes);
    return light;
}

} // namespace

std::vector<PunctualLight> readPunctualLights(const GltfDocument& document,
                                              const std::vector<PlacedNode>& nodes, GltfNotes& notes) {
    std::vector<PunctualLight> lights;
    for (const PlacedNode& placed : nodes) {
        const JsonView node = document.list("nodes")[placed.node];
        const std::optional<size_t> number = node["extensions"]["KHR_lights_punctual"].index("light");
        if (!number || !placed.isVisible)
            continue;
        const JsonView source = document.punctualLights()[*number];
        const std::string& ownName = source.text("name").empty() ? node.text("name") : source.text("name");
        const std::string name = describe("light", *number, ownName);
        std::optional<PunctualLight> light = readLight(source, name, notes);
        if (!light)
            continue;
        light->name = printable(ownName);
        if (placeLight(placed.toWorld, *light))
            lights.push_back(*light);
        else
            notes.addObject("lights without a place or a direction were left out", name);
    }
    return lights;
}

} // namespace lavalight
