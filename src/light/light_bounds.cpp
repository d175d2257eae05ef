// Based on: Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018,
// section 4.1.
#include "light/light_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lavalight {
namespace {

using std::numbers::pi;

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

// `v` turned by `angle` around the unit vector `axis`. Rodrigues' formula.
glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
    const double c = std::cos(angle);
    return v * c + glm::cross(axis, v) * std::sin(angle) + axis * (glm::dot(axis, v) * (1.0 - c));
}

// Algorithm 1 of Conty Estevez and Kulla. The axes of two-sided lights may point either way.
LightCone unite(LightCone a, LightCone b, bool axesMayTurn) {
    if (axesMayTurn && glm::dot(a.axis, b.axis) < 0.0)
        b.axis = -b.axis;
    if (b.spread > a.spread)
        std::swap(a, b);
    const double between = angleBetween(a.axis, b.axis);
    const double falloff = std::max(a.falloff, b.falloff);
    if (std::min(between + b.spread, pi) <= a.spread)
        return {a.axis, a.spread, falloff};
    const double spread = 0.5 * (a.spread + between + b.spread);
    const glm::dvec3 turnAxis = glm::cross(a.axis, b.axis);
    const double length = glm::length(turnAxis);
    if (spread >= pi || length == 0.0)
        return {a.axis, pi, falloff};
    return {glm::normalize(rotated(a.axis, turnAxis / length, spread - a.spread)), spread, falloff};
}

LightBounds boundsOf(const Mesh& mesh, const Material& material, const glm::uvec3& corners, double power) {
    const glm::dvec3 v0(mesh.positions[corners.x]);
    const glm::dvec3 v1(mesh.positions[corners.y]);
    const glm::dvec3 v2(mesh.positions[corners.z]);
    const glm::dvec3 normal = glm::cross(v1 - v0, v2 - v0);
    LightBounds bounds;
    bounds.lower = glm::min(glm::min(v0, v1), v2);
    bounds.upper = glm::max(glm::max(v0, v1), v2);
    bounds.cone = {normal / glm::length(normal), 0.0, 0.5 * pi};
    bounds.isTwoSided = material.doubleSided;
    // Intensity of a Lambert emitter along its normal.
    bounds.intensity = power / (material.doubleSided ? 2.0 * pi : pi);
    return bounds;
}

} // namespace

LightBounds unite(const LightBounds& a, const LightBounds& b) {
    const bool isTwoSided = a.isTwoSided || b.isTwoSided;
    return {glm::min(a.lower, b.lower),        glm::max(a.upper, b.upper),
            unite(a.cone, b.cone, isTwoSided), isTwoSided,
            a.intensity + b.intensity,         std::max(a.range, b.range)};
}

std::vector<LightBounds> boundsOf(const Scene& scene, const Emitters& emitters) {
    std::vector<LightBounds> bounds(emitters.list.size());
    size_t id = 0;
    for (const Mesh& mesh : scene.meshes)
        for (const glm::uvec3& triangle : mesh.triangles)
            if (const uint32_t emitter = emitters.emitterOfTriangle[id++]; emitter != kNoEmitter)
                bounds[emitter] =
                    boundsOf(mesh, scene.materials[mesh.material], triangle, emitters.list[emitter].power);
    return bounds;
}

LightBounds boundsOf(const PunctualLight& light) {
    LightBounds bounds;
    bounds.lower = bounds.upper = glm::dvec3(light.position);
    bounds.intensity = (double{light.intensity.r} + light.intensity.g + light.intensity.b) / 3.0;
    bounds.range = light.range;
    if (light.kind == PunctualKind::spot)
        bounds.cone = {glm::dvec3(light.direction), light.innerConeAngle,
                       double{light.outerConeAngle} - light.innerConeAngle};
    else
        bounds.cone = {{0.0, 0.0, 1.0}, pi, 0.0};
    return bounds;
}

} // namespace lavalight
