#include "support/sound_scene.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace lavalight::test {
namespace {

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isUnit(const glm::vec3& v) {
    return std::abs(glm::length(v) - 1.0f) < 1e-5f; // rounding of a normalization
}

std::string unsoundMesh(const Mesh& mesh, const Scene& scene) {
    const size_t vertices = mesh.positions.size();
    const auto fits = [&](size_t count) { return count == 0 || count == vertices; };
    if (mesh.material >= scene.materials.size())
        return "material out of range";
    if (mesh.triangles.empty())
        return "no triangles";
    if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), isFinite))
        return "position not finite";
    if (!fits(mesh.normals.size()) || !fits(mesh.colors.size()) || !fits(mesh.tangents.size()) ||
        !std::all_of(mesh.uvs.begin(), mesh.uvs.end(), [&](const auto& set) { return fits(set.size()); }))
        return "attributes of different counts";
    if (!std::all_of(mesh.normals.begin(), mesh.normals.end(), isUnit))
        return "normal not of unit length";
    if (!std::all_of(mesh.tangents.begin(), mesh.tangents.end(),
                     [](const glm::vec4& t) { return isUnit(t) && std::abs(t.w) == 1.0f; }))
        return "tangent not of unit length, or without a side";
    for (const std::vector<glm::vec2>& set : mesh.uvs)
        for (const glm::vec2& uv : set)
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
                return "texture coordinate not finite";
    for (const glm::vec4& color : mesh.colors)
        if (!glm::all(glm::greaterThanEqual(color, glm::vec4(0.0f))) ||
            !glm::all(glm::lessThanEqual(color, glm::vec4(1.0f))))
            return "colour outside 0 to 1";
    for (const glm::uvec3& t : mesh.triangles)
        if (std::max({t.x, t.y, t.z}) >= vertices)
            return "index out of range";
    return {};
}

std::string unsoundMaterial(const Material& material, const Scene& scene) {
    for (const std::optional<Texture>& texture : material.textures) {
        if (!texture)
            continue;
        if (texture->picture >= scene.pictures.size())
            return "picture out of range";
        if (!isFinite(texture->uRow) || !isFinite(texture->vRow))
            return "texture transform not finite";
    }
    if (!isFinite(material.baseColor) || !isFinite(material.emission) || !std::isfinite(material.normalScale))
        return "factor not finite";
    return {};
}

std::string unsoundLight(const PunctualLight& light) {
    if (!isFinite(light.position) || !isFinite(light.intensity))
        return "place or intensity not finite";
    if (!isUnit(light.direction))
        return "direction not of unit length";
    if (!(light.range >= 0.0f)) // NaN is not
        return "range below 0";
    return light.innerConeAngle <= light.outerConeAngle ? "" : "cones inside out";
}

std::string unsoundCamera(const Camera& camera) {
    if (!isFinite(camera.position))
        return "position not finite";
    if (!isUnit(camera.right) || !isUnit(camera.up) || !isUnit(camera.forward))
        return "axis not of unit length";
    if (!std::isfinite(camera.verticalFov) || !std::isfinite(camera.halfHeight))
        return "view not finite";
    if (camera.projection == Projection::perspective ? camera.verticalFov <= 0.0f : camera.halfHeight <= 0.0f)
        return "view without height";
    return !camera.aspect || (std::isfinite(*camera.aspect) && *camera.aspect > 0.0f) ? "" : "aspect";
}

// The first finding among `objects`, with its place.
template <class Objects, class Check>
void find(std::string& finding, const char* kind, const Objects& objects, const Check& check) {
    for (size_t i = 0; i < objects.size() && finding.empty(); ++i) {
        const std::string problem = check(objects[i]);
        if (!problem.empty())
            finding = fmt::format("{} {}: {}", kind, i, problem);
    }
}

std::string unsoundLine(const std::string& line) {
    return std::any_of(line.begin(), line.end(), [](unsigned char c) { return c < 0x20; })
               ? "more than one line"
               : "";
}

} // namespace

std::string unsoundPart(const Scene& scene) {
    if (scene.cameras.empty() || scene.materials.empty())
        return "no camera, or no material";
    if (!isFinite(scene.bounds.lower) || !isFinite(scene.bounds.upper))
        return "bounds not finite";
    if (!isFinite(glm::vec3(scene.origin)))
        return "origin not finite";
    std::string finding;
    find(finding, "mesh", scene.meshes, [&](const Mesh& mesh) { return unsoundMesh(mesh, scene); });
    find(finding, "material", scene.materials,
         [&](const Material& material) { return unsoundMaterial(material, scene); });
    find(finding, "light", scene.punctualLights, unsoundLight);
    find(finding, "camera", scene.cameras, unsoundCamera);
    find(finding, "warning", scene.warnings, unsoundLine);
    return finding;
}

} // namespace lavalight::test
