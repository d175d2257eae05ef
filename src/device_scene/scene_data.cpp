#include "device_scene/scene_data.h"

#include <span>
#include <string>

#include <fmt/format.h>

#include "accel/lift_clearance.h"
#include "accel/triangle.h"
#include "base/error.h"
#include "base/os/memory.h"
#include "device_scene/gpu_lights.h"
#include "device_scene/octahedral.h"
#include "device_scene/scene_features.h"
#include "scene/coverage.h"
#include "scene/solids.h"
#include "scene/tangents.h"

namespace lavalight {
namespace {

uint32_t materialWord(const Mesh& mesh, const Material& material, bool isTransparent) {
    uint32_t word = mesh.material;
    if (isTransparent)
        word |= kAlphaBit;
    if (mesh.normals.empty())
        word |= kFlatBit;
    if (material.doubleSided || boundsSolid(material))
        word |= kNeverCulledBit; // the far side of a body is part of what is seen through it
    return word;
}

// Material word of every triangle, in the scene's numbering.
std::vector<uint32_t> materialWords(const Scene& scene) {
    std::vector<uint32_t> words;
    words.reserve(scene.triangleCount());
    const std::vector<bool> transparent = transparentMeshes(scene);
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        words.insert(words.end(), mesh.triangles.size(),
                     materialWord(mesh, scene.materials[mesh.material], transparent[i]));
    }
    return words;
}

// Rays start on the triangles themselves where another surface is in the way of the smooth one.
void keepCrowdedDown(const Scene& scene, std::span<const Triangle> triangles, std::span<uint32_t> words) {
    const std::vector<bool> crowded = crowdedLifts(scene, triangles);
    for (size_t i = 0; i < crowded.size(); ++i)
        if (crowded[i])
            words[i] |= kOwnPlaneBit;
}

std::vector<TriangleRecord> packTriangles(std::span<const Triangle> triangles, const Emitters& emitters,
                                          std::span<const uint32_t> materials) {
    std::vector<TriangleRecord> packed;
    packed.reserve(triangles.size());
    for (uint32_t id = 0; id < triangles.size(); ++id) {
        const Triangle& t = triangles[id];
        packed.push_back({t.v0, {id}, t.v1, emitters.emitterOfTriangle[id], t.v2, materials[id]});
    }
    return packed;
}

std::vector<TriangleNormals> packNormals(const Scene& scene) {
    std::vector<TriangleNormals> packed;
    packed.reserve(scene.triangleCount());
    for (const Mesh& mesh : scene.meshes) {
        const uint32_t solid = mesh.solid;
        for (const glm::uvec3& t : mesh.triangles)
            packed.push_back(mesh.normals.empty()
                                 ? TriangleNormals{0, 0, 0, solid}
                                 : TriangleNormals{encodeOctahedral(mesh.normals[t.x]),
                                                   encodeOctahedral(mesh.normals[t.y]),
                                                   encodeOctahedral(mesh.normals[t.z]), solid});
    }
    return packed;
}

uint32_t materialFlags(const Material& material) {
    return (material.doubleSided ? kMaterialDoubleSided : 0u) | (material.isSolid ? kMaterialSolid : 0u) |
           (material.isUnlit ? kMaterialUnlit : 0u) | (material.isGlossiness ? kMaterialGlossiness : 0u);
}

// Per metre: what is left after attenuationDistance is attenuationColor. A channel of 0 is as good as black
// after 1/50 of it.
glm::vec3 absorption(const Material& material) {
    constexpr float kDarkest = 1e-20f;
    return -glm::log(glm::max(material.attenuationColor, glm::vec3(kDarkest))) / material.attenuationDistance;
}

MaterialRecord packMaterial(const Material& m) {
    MaterialRecord r{};
    r.baseColor = m.baseColor;
    r.metallic = m.metallic;
    r.emission = m.emission;
    r.roughness = m.roughness;
    r.specularColor = m.specularColor;
    r.specular = m.specular;
    r.ior = m.ior;
    r.transmission = m.transmission;
    r.flags = materialFlags(m);
    r.alpha = m.alpha;
    r.alphaCutoff = m.alphaMode == AlphaMode::mask ? m.alphaCutoff : -1.0f;
    r.normalScale = m.normalScale;
    r.attenuation = absorption(m);
    r.dispersion = m.dispersion;
    r.clearcoat = m.clearcoat;
    r.clearcoatRoughness = m.clearcoatRoughness;
    r.clearcoatNormalScale = m.clearcoatNormalScale;
    r.anisotropy = m.anisotropy;
    r.sheenColor = m.sheenColor;
    r.sheenRoughness = m.sheenRoughness;
    r.anisotropyRotation = m.anisotropyRotation;
    r.iridescence = m.iridescence;
    r.iridescenceIor = m.iridescenceIor;
    r.iridescenceThicknessMinimum = m.iridescenceThicknessMinimum;
    r.iridescenceThicknessMaximum = m.iridescenceThicknessMaximum;
    r.diffuseTransmission = m.diffuseTransmission;
    r.diffuseTransmissionColor = m.diffuseTransmissionColor;
    return r;
}

std::vector<SolidRecord> packSolids(const Scene& scene) {
    std::vector<SolidRecord> packed{{glm::vec3(0.0f), 1.0f, 0.0f, {}}};
    for (const Solid& solid : scene.solids) {
        const Material& m = scene.materials[scene.meshes[solid.mesh].material];
        packed.push_back(
            {absorption(m), m.ior, m.transmission > 0.0f && m.ior > 0.0f ? m.dispersion : 0.0f, {}});
    }
    return packed;
}

// firstTextures: per material; empty: no textures are looked up.
std::vector<MaterialRecord> packMaterials(const Scene& scene, std::span<const uint32_t> firstTextures) {
    std::vector<MaterialRecord> packed;
    for (const Material& material : scene.materials)
        packed.push_back(packMaterial(material));
    for (size_t i = 0; i < firstTextures.size(); ++i) {
        packed[i].textureSlots = textureSlots(scene.materials[i]);
        packed[i].firstTexture = firstTextures[i];
    }
    return packed;
}

// Says which plane of tangents the textures of each material go by, if there is more than one.
void packTangentPlanes(const Scene& scene, std::vector<MaterialRecord>& packed) {
    const uint32_t planes = tangentPlanes(scene);
    const auto triangles = static_cast<uint32_t>(scene.triangleCount());
    for (size_t i = 0; i < packed.size() && planes > 1; ++i) {
        const TangentSpaces wanted = tangentSpaces(scene.materials[i]);
        packed[i].coatTangents = wanted.coat < planes ? wanted.coat * triangles : 0u;
        packed[i].anisotropyTangents = wanted.anisotropy < planes ? wanted.anisotropy * triangles : 0u;
    }
}

void packSurfaceDetail(const Scene& scene, SceneData& data) {
    if ((data.features & kFeatureTextures) != 0) {
        data.textures = packTextures(scene);
        data.uvs = packUvs(scene);
    }
    if ((data.features & kFeatureVertexColors) != 0)
        data.colors = packColors(scene);
    if ((data.features & kFeatureTangents) != 0)
        data.tangents = packTangents(scene);
}

// Each cell's scale, and the texel at its lower right corner: the last row is there twice.
std::vector<glm::vec4> packEnvironmentMap(const Image& map, std::span<const float> scales) {
    std::vector<glm::vec4> packed;
    packed.reserve(scales.size());
    for (size_t i = 0; i < scales.size(); ++i)
        packed.emplace_back(map.pixels[i < map.pixels.size() ? i : i - map.width], scales[i]);
    return packed;
}

// Linux kills a process that takes what it was granted and there is not.
void requireMemoryForTriangles(const Scene& scene) {
    // Bytes that a triangle takes with its BVH's workspace, at the peak: measured 500 (7.66 million triangles
    // of TeapotsGalore) and 570 (dense-3000000).
    constexpr uint64_t kBytesPerTriangle = 512;
    const uint64_t triangles = scene.triangleCount();
    if (const std::string shortage = memoryShortage(kBytesPerTriangle * triangles); !shortage.empty())
        throw Error(fmt::format("cannot prepare {}: its {} triangles {}: simplify the scene", scene.source,
                                triangles, shortage));
}

} // namespace

SceneData packScene(const Scene& scene, const Lights& lights, AcceleratorKind kind) {
    requireMemoryForTriangles(scene);
    const std::vector<Triangle> triangles = sceneTriangles(scene);
    SceneData data;
    data.features = sceneFeatures(scene, lights);
    packSurfaceDetail(scene, data);
    std::vector<uint32_t> words = materialWords(scene);
    keepCrowdedDown(scene, triangles, words);
    data.accelerator = buildAccelerator(triangles, words, kind);
    data.triangles = packTriangles(triangles, lights.emitters, words);
    data.normals = packNormals(scene);
    data.materials = packMaterials(scene, data.textures.firstRecords);
    packTangentPlanes(scene, data.materials);
    data.solids = packSolids(scene);
    data.lights = packLights(lights);
    data.punctuals = packPunctuals(scene, lights);
    data.lightTree = packLightTree(lights.tree, scene.bounds.radius());
    if (lights.environmentMap) {
        data.environmentMap = packEnvironmentMap(scene.environmentMap->image, lights.environmentMap->scales);
        data.environmentQuads = lights.environmentMap->quads;
    }
    return data;
}

SceneData packScene(const Scene& scene, AcceleratorKind kind) {
    return packScene(scene, collectLights(scene, scene.environment, LightSelection::power), kind);
}

} // namespace lavalight
