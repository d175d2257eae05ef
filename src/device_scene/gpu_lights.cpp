#include "device_scene/gpu_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "device_scene/octahedral.h"

namespace lavalight {
namespace {

// What light number i is, in the encoding of LightRecord::source; emitters by their triangles.
std::vector<uint32_t> lightSources(const Lights& lights) {
    std::vector<uint32_t> sources;
    for (const Emitter& emitter : lights.emitters.list)
        sources.push_back(kLightTriangle << kLightKindShift | emitter.triangle);
    for (uint32_t i = 0; i < lights.punctuals.size(); ++i)
        sources.push_back(kLightPunctual << kLightKindShift | i);
    if (lights.environment)
        sources.push_back(kLightEnvironment << kLightKindShift);
    if (!lights.tree.nodes.empty())
        sources.push_back(kLightTree << kLightKindShift);
    return sources;
}

// 0 for a light without end; finite, so that its product with a distance of 0 is 0.
float inverseSquare(double range) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    return static_cast<float>(std::min(1.0 / (range * range), kLargest));
}

// Cone scale and offset as KHR_lights_punctual defines them, with its guard against equal angles.
PunctualRecord packPunctual(const PunctualLight& light) {
    const float inner = std::cos(light.innerConeAngle);
    const float outer = std::cos(light.outerConeAngle);
    const float scale = 1.0f / std::max(0.001f, inner - outer);
    const uint32_t kind = light.kind == PunctualKind::point  ? kPunctualPoint
                          : light.kind == PunctualKind::spot ? kPunctualSpot
                                                             : kPunctualDirectional;
    return {light.position,
            kind,
            light.direction,
            scale,
            light.intensity,
            -outer * scale,
            inverseSquare(light.range),
            {}};
}

// Radians that an axis in octahedral encoding may be off by.
constexpr double kAxisError = 1e-4;

// cos(angle) as a 16-bit signed normalised number, rounded down: the angle grows.
uint32_t packCosine(double angle) {
    const double scaled = std::floor(std::cos(std::min(angle, std::numbers::pi)) * 32767.0);
    return static_cast<uint32_t>(static_cast<int32_t>(scaled)) & 0xffffu;
}

LightTreeRecord packLightTreeNode(const LightTreeNode& node, double intensityScale) {
    const LightBounds& bounds = node.bounds;
    const LightCone& cone = bounds.cone;
    const glm::vec3 center(bounds.center());
    const glm::dvec3 farthest =
        glm::max(bounds.upper - glm::dvec3(center), glm::dvec3(center) - bounds.lower);
    const double radius = glm::length(farthest) * (1.0 + std::numeric_limits<float>::epsilon());
    // A single normal is kept exact but for its encoding; what little that hides, BSDF sampling finds.
    const double spread = cone.spread > 0.0 ? cone.spread + kAxisError : 0.0;
    return {center,
            static_cast<float>(radius),
            encodeOctahedral(glm::vec3(cone.axis)),
            packCosine(spread) | packCosine(cone.falloff) << 16u,
            static_cast<float>(bounds.intensity * intensityScale),
            node.index | (node.isLeaf ? kLightTreeLeafBit : 0u) |
                (bounds.isTwoSided ? kLightTreeTwoSidedBit : 0u),
            inverseSquare(bounds.range),
            {}};
}

} // namespace

std::vector<LightRecord> packLights(const Lights& lights) {
    const std::vector<uint32_t> sources = lightSources(lights);
    std::vector<LightRecord> packed;
    for (uint32_t i = 0; i < lights.firstColumn; ++i) // in the tree, whose column is the last
        packed.push_back({0.0f, lights.tree.paths[i], lights.table.back().pmf, sources[i]});
    for (const AliasEntry& column : lights.table)
        packed.push_back(
            {column.probability, lights.firstColumn + column.alias, column.pmf, sources[packed.size()]});
    return packed;
}

std::vector<LightRecord> inRecords(std::vector<LightRecord> lights,
                                   std::span<const uint32_t> recordOfTriangle) {
    for (LightRecord& light : lights)
        if (light.source >> kLightKindShift == kLightTriangle)
            light.source =
                kLightTriangle << kLightKindShift | recordOfTriangle[light.source & kLightIndexMask];
    return lights;
}

std::vector<PunctualRecord> packPunctuals(const Scene& scene, const Lights& lights) {
    std::vector<PunctualRecord> packed;
    for (const uint32_t index : lights.punctuals)
        packed.push_back(packPunctual(scene.punctualLights[index]));
    return packed;
}

std::vector<LightTreeRecord> packLightTree(const LightTree& tree, double sceneRadius) {
    if (tree.nodes.empty())
        return {};
    const double size2 = sceneRadius > 0.0 ? sceneRadius * sceneRadius : 1.0;
    const double scale = size2 / tree.nodes[0].bounds.intensity;
    std::vector<LightTreeRecord> packed;
    packed.reserve(tree.nodes.size());
    for (const LightTreeNode& node : tree.nodes)
        packed.push_back(packLightTreeNode(node, scale));
    return packed;
}

} // namespace lavalight
