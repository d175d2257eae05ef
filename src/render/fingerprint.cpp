#include "render/fingerprint.h"

#include <span>

#include "base/content_hash.h"
#include "render/renderer.h"

namespace lavalight {
namespace {

template <typename... Values>
std::string hashOf(const Values&... values) {
    ContentHash hash;
    (hash.add(std::vector<Values>{values}), ...);
    return hash.text();
}

template <typename... Records>
std::string hashOfAll(const std::vector<Records>&... records) {
    ContentHash hash;
    (hash.add(records), ...);
    return hash.text();
}

std::string shadersOf(const Renderer& renderer) {
    ContentHash hash;
    for (const auto& [name, kernel] : renderer.kernels().all()) {
        hash.add(name);
        hash.add(kernel.code().content);
    }
    hash.add(renderer.scene().albedoTable().kernelContent);
    return hash.text();
}

} // namespace

Fingerprints fingerprintsOf(const SceneData& scene) {
    // A member that is added must find its place below.
    const auto& [bvh, leafTriangles, normals, materials, lights, punctuals, lightTree, textures, uvs, colors,
                 tangents, environmentMap, environmentQuads, features] = scene;
    const auto& [pictures, textureRecords, firstRecords] = textures;
    return {
        {"geometry", hashOfAll(bvh.nodes, leafTriangles, normals, uvs, colors, tangents)},
        {"materials", hashOfAll(materials, std::vector{features})},
        {"textures", hashOfAll(pictures, textureRecords, firstRecords)},
        {"lights", hashOfAll(lights, punctuals, lightTree)},
        {"environment map", hashOfAll(environmentMap, environmentQuads)},
    };
}

Fingerprints fingerprintsOf(const Renderer& renderer) {
    const FrameParameters& f = renderer.frame();
    Fingerprints parts = renderer.scene().fingerprints();
    parts.emplace_back("environment",
                       hashOf(f.environment, f.environmentLight, f.environmentRotation, f.environmentWidth,
                              f.environmentHeight, f.firstLightColumn, f.lightColumns));
    // cameraRight follows from the others and the image's size.
    parts.emplace_back("view", hashOf(f.cameraPosition, f.projection, f.cameraUp, f.cameraForward,
                                      f.lensRadius, f.focusDistance, f.sceneCenter, f.sceneRadius));
    parts.emplace_back("shaders", shadersOf(renderer));
    return parts;
}

} // namespace lavalight
