#include "device_scene/fingerprint.h"

#include <span>

#include "base/content_hash.h"

namespace lavalight {
namespace {

template <typename... Records>
std::string hashOfAll(const std::vector<Records>&... records) {
    ContentHash hash;
    (hash.add(records), ...);
    return hash.text();
}

} // namespace

Fingerprints fingerprintsOf(const SceneData& scene) {
    // A member that is added must find its place below.
    const auto& [accelerator, triangles, normals, materials, solids, lights, punctuals, lightTree, textures,
                 uvs, colors, tangents, environmentMap, environmentQuads, features] = scene;
    const auto& [pictures, textureRecords, firstRecords] = textures;
    return {
        {"geometry", hashOfAll(triangles, normals, uvs, colors, tangents)},
        {"materials", hashOfAll(materials, solids, std::vector{features})},
        {"textures", hashOfAll(pictures, textureRecords, firstRecords)},
        {"lights", hashOfAll(lights, punctuals, lightTree)},
        {"environment map", hashOfAll(environmentMap, environmentQuads)},
        {"accelerator", accelerator.name()},
    };
}

} // namespace lavalight
