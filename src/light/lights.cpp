// Powers of lights, and the distribution over all of them.
#include "light/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {
namespace {

using std::numbers::pi;

double meanOf(const glm::vec3& v) {
    return (double{v.x} + v.y + v.z) / 3.0;
}

// 1 - cos(angle) without the cancellation that would take the power, and so the light, from narrow cones.
double versine(double angle) {
    const double half = std::sin(0.5 * angle);
    return 2.0 * half * half;
}

void requireFinite(double power, const std::string& light) {
    if (!std::isfinite(power))
        throw Error(fmt::format("cannot sample {}: its power is {} W", light, power));
}

// Fills `punctuals` with what has power, and appends the powers.
void addPunctuals(const Scene& scene, Lights& lights) {
    for (size_t i = 0; i < scene.punctualLights.size(); ++i) {
        const PunctualLight& light = scene.punctualLights[i];
        const double power = powerOf(light, scene.bounds);
        requireFinite(power, fmt::format("light {} '{}'", i, light.name));
        if (power <= 0.0)
            continue;
        lights.punctuals.push_back(static_cast<uint32_t>(i));
        lights.powers.push_back(power);
    }
}

} // namespace

double powerOf(const PunctualLight& light, const Bounds& bounds) {
    const double intensity = meanOf(light.intensity);
    const double inner = versine(light.innerConeAngle);
    const double outer = versine(light.outerConeAngle);
    switch (light.kind) {
    case PunctualKind::point:
        return 4.0 * pi * intensity;
    case PunctualKind::spot: // full inside, and a third of it between: the mean of a squared ramp
        return 2.0 * pi * intensity * (inner + (outer - inner) / 3.0);
    case PunctualKind::directional:
        return pi * bounds.radius() * bounds.radius() * intensity;
    }
    return 0.0;
}

double environmentPower(const glm::vec3& radiance, const Bounds& bounds) {
    const double area = 4.0 * pi * bounds.radius() * bounds.radius();
    return pi * area * meanOf(radiance);
}

Lights collectLights(const Scene& scene, const glm::vec3& environment, LightSelection selection) {
    Lights lights;
    lights.emitters = findEmitters(scene);
    for (const Emitter& emitter : lights.emitters.list)
        lights.powers.push_back(emitter.power);
    addPunctuals(scene, lights);
    const double power = environmentPower(environment, scene.bounds);
    requireFinite(power, "the environment");
    if (power > 0.0) {
        lights.environment = static_cast<uint32_t>(lights.powers.size());
        lights.powers.push_back(power);
    }
    std::vector<double> weights = lights.powers;
    if (selection == LightSelection::uniform)
        std::fill(weights.begin(), weights.end(), 1.0);
    lights.table = buildAliasTable(weights);
    return lights;
}

} // namespace lavalight
