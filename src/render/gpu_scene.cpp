#include "render/gpu_scene.h"

#include <chrono>

#include <glm/gtc/packing.hpp>

#include "accel/triangle.h"
#include "light/emitters.h"
#include "render/albedo_table.h"
#include "render/octahedral.h"
#include "shared/scene.h"

namespace lavalight {
namespace {

uint32_t materialWord(const Mesh& mesh, const Material& material) {
    uint32_t word = mesh.material;
    if (mesh.normals.empty())
        word |= kFlatBit;
    if (material.doubleSided)
        word |= kNeverCulledBit;
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
            packed.push_back(mesh.normals.empty()
                                 ? TriangleNormals{}
                                 : TriangleNormals{encodeOctahedral(mesh.normals[t.x]),
                                                   encodeOctahedral(mesh.normals[t.y]),
                                                   encodeOctahedral(mesh.normals[t.z]), 0});
    return packed;
}

std::vector<MaterialRecord> packMaterials(const Scene& scene) {
    std::vector<MaterialRecord> packed;
    for (const Material& m : scene.materials)
        packed.push_back({m.baseColor, m.metallic, m.emission, m.roughness, m.specularColor, m.specular, m.ior,
                          m.doubleSided ? 1u : 0u, 0, 0});
    return packed;
}

std::vector<EmitterRecord> packEmitters(const Emitters& emitters, const Bvh& bvh) {
    std::vector<EmitterRecord> packed(emitters.list.size());
    for (size_t i = 0; i < packed.size(); ++i)
        packed[i] = {emitters.table[i].probability, emitters.table[i].alias, emitters.table[i].pmf, 0};
    for (size_t leaf = 0; leaf < bvh.leafTriangles.size(); ++leaf) {
        const uint32_t emitter = emitters.emitterOfTriangle[bvh.leafTriangles[leaf]];
        if (emitter != kNoEmitter)
            packed[emitter].leafTriangle = static_cast<uint32_t>(leaf);
    }
    return packed;
}

} // namespace

// Everything in the layout of the device, before any of it is uploaded.
struct GpuScene::Prepared {
    Bvh bvh;
    std::vector<LeafTriangle> leafTriangles;
    std::vector<TriangleNormals> normals;
    std::vector<MaterialRecord> materials;
    std::vector<EmitterRecord> emitters;
};

GpuScene::Prepared GpuScene::prepare(const Scene& scene) {
    const std::vector<Triangle> triangles = sceneTriangles(scene);
    const Emitters emitters = findEmitters(scene);
    Prepared prepared;
    prepared.bvh = buildBvh(triangles);
    prepared.leafTriangles = packLeafTriangles(prepared.bvh, triangles, emitters, materialWords(scene));
    prepared.normals = packNormals(scene);
    prepared.materials = packMaterials(scene);
    prepared.emitters = packEmitters(emitters, prepared.bvh);
    return prepared;
}

namespace {

template <typename T> gpu::Buffer uploadTexels(gpu::Device& device, const char* name, const std::vector<T>& data) {
    static_assert(sizeof(T) % 16 == 0);
    gpu::Buffer buffer(device, name, data.size() * sizeof(T), gpu::BufferUse::texels);
    buffer.upload(std::span<const T>(data));
    return buffer;
}

} // namespace

GpuScene::GpuScene(gpu::Device& device, const Scene& scene) : GpuScene(device, prepare(scene)) {}

GpuScene::GpuScene(gpu::Device& device, const Prepared& prepared)
    : emitterCount_(static_cast<uint32_t>(prepared.emitters.size())), bvhSeconds_(prepared.bvh.buildSeconds),
      nodes_(uploadTexels(device, "BVH nodes", prepared.bvh.nodes)),
      leafTriangles_(uploadTexels(device, "leaf triangles", prepared.leafTriangles)),
      normals_(uploadTexels(device, "triangle normals", prepared.normals)),
      materials_(uploadTexels(device, "materials", prepared.materials)),
      emitters_(uploadTexels(device, "emitters", prepared.emitters)), albedoTable_(makeAlbedoTable(device)) {}

void GpuScene::addTo(gpu::ResourceTable& resources) const {
    resources.set("bvhNodes", nodes_);
    resources.set("leafTriangles", leafTriangles_);
    resources.set("triangleNormals", normals_);
    resources.set("materials", materials_);
    resources.set("emitters", emitters_);
    resources.set("albedoTable", albedoTable_);
}

uint64_t GpuScene::bytes() const {
    return nodes_.bytes() + leafTriangles_.bytes() + normals_.bytes() + materials_.bytes() + emitters_.bytes() +
           albedoTable_.bytes();
}

} // namespace lavalight
