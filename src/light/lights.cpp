// Powers of lights, and the distribution over all of them.
#include "light/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
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

// Mean of the window 1 - (d / range)^4 over the distances from 0 to `reach`.
double meanOfWindow(double range, double reach) {
    if (!(reach > 0.0))
        return 1.0;
    if (reach >= range)
        return 0.8 * range / reach;
    const double part = reach / range;
    return 1.0 - 0.2 * part * part * part * part;
}

void requireFinite(double power, const std::string& light) {
    if (!std::isfinite(power))
        throw Error(fmt::format("cannot sample {}: its power is {} W", light, power));
}

bool isAtInfinity(const PunctualLight& light) {
    return light.kind == PunctualKind::directional;
}

// Fills `punctuals` with what has power, and appends the powers.
void addPunctuals(const Scene& scene, bool atInfinity, Lights& lights) {
    for (size_t i = 0; i < scene.punctualLights.size(); ++i) {
        const PunctualLight& light = scene.punctualLights[i];
        if (isAtInfinity(light) != atInfinity)
            continue;
        const double power = powerOf(light, scene.bounds);
        requireFinite(power, fmt::format("light {} '{}'", i, light.name));
        if (power <= 0.0)
            continue;
        lights.punctuals.push_back(static_cast<uint32_t>(i));
        lights.powers.push_back(power);
    }
}

// The share of samples that the sun gets beside the rest of the environment: by what both bring, and enough
// for each.
double shareOf(const glm::dvec3& ofSun, const glm::dvec3& ofMap) {
    const double sun = ofSun.x + ofSun.y + ofSun.z;
    const double all = sun + ofMap.x + ofMap.y + ofMap.z;
    return all > 0.0 ? std::clamp(sun / all, 0.2, 0.8) : 0.5;
}

// A black environment leaves no trace. Around an empty scene, which it cannot light, an environment is seen
// all the same.
void addEnvironment(const Scene& scene, const glm::vec3& radiance, Lights& lights) {
    glm::dvec3 mean(radiance);
    if (scene.environmentMap && radiance != glm::vec3(0.0f)) {
        lights.environmentMap = makeEnvironmentDistribution(scene.environmentMap->image);
        glm::dvec3 ofMap = lights.environmentMap->meanRadiance;
        lights.sun = scene.environmentMap->sun;
        if (lights.sun) {
            const glm::dvec3 ofSun = 0.5 * double{lights.sun->size} * glm::dvec3(lights.sun->radiance);
            lights.sunShare = shareOf(ofSun, ofMap);
            ofMap += ofSun;
        }
        mean *= ofMap;
    }
    const double power = environmentPower(glm::vec3(mean), scene.bounds);
    requireFinite(power, "the environment");
    if (mean == glm::dvec3(0.0)) {
        lights.environmentMap.reset();
        lights.sun.reset();
        return;
    }
    lights.environmentRadiance = radiance;
    if (power > 0.0) {
        lights.environment = static_cast<uint32_t>(lights.powers.size());
        lights.powers.push_back(power);
    }
}

// The tree over all lights that have a place.
LightTree treeOf(const Scene& scene, const Lights& lights) {
    std::vector<LightBounds> bounds = boundsOf(scene, lights.emitters);
    for (const uint32_t index : lights.punctuals)
        if (const PunctualLight& light = scene.punctualLights[index]; !isAtInfinity(light))
            bounds.push_back(boundsOf(light));
    return buildLightTree(bounds);
}

// MIS finds a constant environment by BSDF rays as well as by NEE, which samples the cosine, too: where a
// light is to be found beside it, samples for it are nearly lost. Measured on dense-30000 (a quad and the
// sky), relMSE * time beside picking by power: 0.24 with a share of 1/2, 0.12 with 1/4, 0.08 with 1/8, 0.06
// with 1/20.
constexpr double kWeightOfFoundEnvironment = 1.0 / 16.0;

// A map's sun or lamps are found by light samples alone: the map is picked by its power beside the tree's,
// within bounds, since powers say little about a single point. Measured on dense-3000 (a quad) under a clear
// sky with its sun, where the map brings nearly all: relMSE of equal samples 0.115 with a share of 1/17,
// 0.029 with 1/5, 0.0075 with 1/2, 0.0037 with 3/4.
constexpr double kMostWeightOfMap = 3.0;

double environmentWeight(const Lights& lights, bool bsdfFindsEnvironment) {
    if (!lights.environmentMap)
        return bsdfFindsEnvironment ? kWeightOfFoundEnvironment : 1.0;
    const double local = std::accumulate(
        lights.powers.begin(), lights.powers.begin() + static_cast<std::ptrdiff_t>(lights.firstColumn), 0.0);
    return local > 0.0 ? std::clamp(lights.powers.back() / local, 1.0 / kMostWeightOfMap, kMostWeightOfMap)
                       : 1.0;
}

std::vector<double> columnWeights(const Lights& lights, bool bsdfFindsEnvironment) {
    if (lights.selection == LightSelection::power)
        return lights.powers;
    std::vector<double> weights(lights.powers.size() - lights.firstColumn, 1.0);
    if (lights.selection == LightSelection::tree && lights.environment)
        weights.back() = environmentWeight(lights, bsdfFindsEnvironment);
    if (!lights.tree.nodes.empty())
        weights.push_back(1.0);
    return weights;
}

} // namespace

double powerOf(const PunctualLight& light, const Bounds& bounds) {
    const double intensity = meanOf(light.intensity) * meanOfWindow(light.range, 2.0 * bounds.radius());
    const double inner = versine(light.innerConeAngle);
    const double outer = versine(light.outerConeAngle);
    switch (light.kind) {
    case PunctualKind::point:
        return 4.0 * pi * intensity;
    case PunctualKind::spot: // full intensity inside, a third of it between: the mean of a squared ramp
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

LightSelection resolveLightSelection(LightSelection selection, size_t localLights, size_t allLights) {
    if (selection != LightSelection::automatic)
        return selection;
    const bool isChoice = localLights > 2 || (localLights > 0 && allLights > localLights);
    return isChoice ? LightSelection::tree : LightSelection::power;
}

Lights collectLights(const Scene& scene, const glm::vec3& environment, LightSelection selection,
                     bool bsdfFindsEnvironment) {
    Lights lights;
    lights.emitters = findEmitters(scene);
    for (const Emitter& emitter : lights.emitters.list)
        lights.powers.push_back(emitter.power);
    addPunctuals(scene, false, lights);
    const size_t atInfinity = lights.powers.size();
    addPunctuals(scene, true, lights);
    addEnvironment(scene, environment, lights);
    lights.selection = resolveLightSelection(selection, atInfinity, lights.powers.size());
    if (lights.selection == LightSelection::tree) {
        lights.tree = treeOf(scene, lights);
        lights.firstColumn = static_cast<uint32_t>(atInfinity);
    }
    lights.table = buildAliasTable(columnWeights(lights, bsdfFindsEnvironment));
    return lights;
}

} // namespace lavalight
