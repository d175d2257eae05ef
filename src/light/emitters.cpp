// Collects emissive triangles.
#include "light/emitters.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/log.h"

namespace lavalight {

namespace {

double triangleArea(const Mesh& mesh, const glm::uvec3& triangle) {
    const glm::dvec3 v0(mesh.positions[triangle.x]);
    const glm::dvec3 v1(mesh.positions[triangle.y]);
    const glm::dvec3 v2(mesh.positions[triangle.z]);
    return 0.5 * glm::length(glm::cross(v1 - v0, v2 - v0));
}

// W/m^2: radiance times pi, the integral of the cosine over the hemisphere, per emitting side. The mean of
// the channels rather than their luminance, since a blue light is as noisy as a green one where it is seen
// alone.
double exitance(const Material& material) {
    const double mean = (double{material.emission.r} + material.emission.g + material.emission.b) / 3.0;
    return mean * std::numbers::pi * (material.doubleSided ? 2.0 : 1.0);
}

// Fills list and emitterOfTriangle.
void collect(const Mesh& mesh, const Material& material, Emitters& emitters) {
    const double exitantPower = exitance(material);
    for (const glm::uvec3& triangle : mesh.triangles) {
        const auto id = static_cast<uint32_t>(emitters.emitterOfTriangle.size());
        emitters.emitterOfTriangle.push_back(kNoEmitter);
        if (!(exitantPower > 0.0))
            continue;
        const double area = triangleArea(mesh, triangle);
        const double power = area * exitantPower;
        if (!std::isfinite(power))
            throw Error(
                fmt::format("cannot use material '{}' as a light: triangle {} of mesh '{}' emits {} W",
                            material.name, id, mesh.name, power));
        if (static_cast<float>(area) <= 0.0f || power <= 0.0)
            continue;
        emitters.emitterOfTriangle.back() = static_cast<uint32_t>(emitters.list.size());
        emitters.list.push_back({id, static_cast<float>(area), power});
    }
}

} // namespace

Emitters findEmitters(const Scene& scene) {
    Emitters emitters;
    emitters.emitterOfTriangle.reserve(scene.triangleCount());
    for (const Mesh& mesh : scene.meshes)
        collect(mesh, scene.materials[mesh.material], emitters);
    return emitters;
}

} // namespace lavalight
