#include "render/gpu_scene.h"

#include <algorithm>

#include "accel/triangle.h"
#include "render/albedo_table.h"
#include "render/gpu_lights.h"
#include "render/octahedral.h"
#include "render/scene_features.h"
#include "shared/scene.h"

namespace lavalight {
namespace {

uint32_t materialWord(const Mesh& mesh, const Material& material) {
    uint32_t word = mesh.material;
    if (mesh.normals.empty())
        word |= kFlatBit;
    if (material.doubleSided || (material.isSolid && material.transmission > 0.0f))
        word |= kNeverCulledBit; // the far side of a glass body is part of what is seen through it
    return word;
}

// Material word of every triangle, in the scene's numbering.
std::vector<uint32_t> materialWords(const Scene& scene) {
    std::vector<uint32_t> words;
    words.reserve(scene.triangleCount());
    for (const Mesh& mesh : scene.meshes)
        words.insert(words.end(), mesh.triangles.size(), materialWord(mesh, scene.materials[mesh.material]));
    return words;
}

std::vector<LeafTriangle> packLeafTriangles(const Bvh& bvh, std::span<const Triangle> triangles,
                                            const Emitters& emitters, std::span<const uint32_t> materials) {
    std::vector<LeafTriangle> packed;
    packed.reserve(bvh.leafTriangles.size());
    for (const uint32_t id : bvh.leafTriangles) {
        const Triangle& t = triangles[id];
        packed.push_back({t.v0, id, t.v1, emitters.emitterOfTriangle[id], t.v2, materials[id]});
    }
    return packed;
}

std::vector<TriangleNormals> packNormals(const Scene& scene) {
    std::vector<TriangleNormals> packed;
    packed.reserve(scene.triangleCount());
    for (const Mesh& mesh : scene.meshes)
        for (const glm::uvec3& t : mesh.triangles)
            packed.push_back(mesh.normals.empty() ? TriangleNormals{}
                                                  : TriangleNormals{encodeOctahedral(mesh.normals[t.x]),
                                                                    encodeOctahedral(mesh.normals[t.y]),
                                                                    encodeOctahedral(mesh.normals[t.z]), 0});
    return packed;
}

uint32_t materialFlags(const Material& material) {
    return (material.doubleSided ? kMaterialDoubleSided : 0u) | (material.isSolid ? kMaterialSolid : 0u);
}

std::vector<MaterialRecord> packMaterials(const Scene& scene) {
    std::vector<MaterialRecord> packed;
    for (const Material& m : scene.materials)
        packed.push_back({m.baseColor, m.metallic, m.emission, m.roughness, m.specularColor, m.specular,
                          m.ior, m.transmission, materialFlags(m), 0});
    return packed;
}

} // namespace

// Everything in the layout of the device, before any of it is uploaded.
struct GpuScene::Prepared {
    Bvh bvh;
    std::vector<LeafTriangle> leafTriangles;
    std::vector<TriangleNormals> normals;
    std::vector<MaterialRecord> materials;
    std::vector<LightRecord> lights;
    std::vector<PunctualRecord> punctuals;
    std::vector<LightTreeRecord> lightTree;
    LightSelection lightSelection;
    LightColumns lightColumns;
    uint32_t environmentLight;
    uint32_t features;
};

GpuScene::Prepared GpuScene::prepare(const Scene& scene, const Lights& lights) {
    const std::vector<Triangle> triangles = sceneTriangles(scene);
    Prepared prepared;
    prepared.bvh = buildBvh(triangles);
    prepared.leafTriangles =
        packLeafTriangles(prepared.bvh, triangles, lights.emitters, materialWords(scene));
    prepared.normals = packNormals(scene);
    prepared.materials = packMaterials(scene);
    prepared.lights = packLights(lights, prepared.bvh);
    prepared.punctuals = packPunctuals(scene, lights);
    prepared.lightTree = packLightTree(lights.tree, scene.bounds.radius());
    prepared.lightSelection = lights.selection;
    prepared.lightColumns = {lights.firstColumn, static_cast<uint32_t>(lights.table.size())};
    prepared.environmentLight = lights.environment.value_or(kNoLight);
    prepared.features = sceneFeatures(scene, lights);
    return prepared;
}

namespace {

// Lambert surfaces never look into the table, whose kernel takes a quarter of a second to compile and run.
gpu::Buffer albedoTableFor(gpu::Device& device, uint32_t features) {
    if ((features & (kFeatureSpecular | kFeatureGlass)) != 0)
        return makeAlbedoTable(device);
    return {device, "albedo table", 0, gpu::BufferUse::texels};
}

template <typename T>
gpu::Buffer uploadTexels(gpu::Device& device, const char* name, const std::vector<T>& data) {
    static_assert(sizeof(T) % 16 == 0);
    gpu::Buffer buffer(device, name, data.size() * sizeof(T), gpu::BufferUse::texels);
    buffer.upload(std::span<const T>(data));
    return buffer;
}

} // namespace

GpuScene::GpuScene(gpu::Device& device, const Scene& scene, const glm::vec3& environment,
                   LightSelection selection, bool bsdfFindsEnvironment)
    : GpuScene(device, prepare(scene, collectLights(scene, environment, selection, bsdfFindsEnvironment))) {}

GpuScene::GpuScene(gpu::Device& device, const Prepared& prepared)
    : lightSelection_(prepared.lightSelection), lightColumns_(prepared.lightColumns),
      environmentLight_(prepared.environmentLight), features_(prepared.features),
      bvhSeconds_(prepared.bvh.buildSeconds), nodes_(uploadTexels(device, "BVH nodes", prepared.bvh.nodes)),
      leafTriangles_(uploadTexels(device, "leaf triangles", prepared.leafTriangles)),
      normals_(uploadTexels(device, "triangle normals", prepared.normals)),
      materials_(uploadTexels(device, "materials", prepared.materials)),
      lights_(uploadTexels(device, "lights", prepared.lights)),
      punctuals_(uploadTexels(device, "punctual lights", prepared.punctuals)),
      lightTree_(uploadTexels(device, "light tree", prepared.lightTree)),
      albedoTable_(albedoTableFor(device, prepared.features)) {}

void GpuScene::addTo(gpu::ResourceTable& resources) const {
    resources.set("bvhNodes", nodes_);
    resources.set("leafTriangles", leafTriangles_);
    resources.set("triangleNormals", normals_);
    resources.set("materials", materials_);
    resources.set("lights", lights_);
    resources.set("punctuals", punctuals_);
    resources.set("lightTree", lightTree_);
    resources.set("albedoTable", albedoTable_);
}

uint64_t GpuScene::bytes() const {
    return nodes_.bytes() + leafTriangles_.bytes() + normals_.bytes() + materials_.bytes() + lights_.bytes() +
           punctuals_.bytes() + lightTree_.bytes() + albedoTable_.bytes();
}

} // namespace lavalight
