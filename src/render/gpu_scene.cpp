#include "render/gpu_scene.h"

#include "render/albedo_table.h"

namespace lavalight {
namespace {

// Lambert surfaces never look into the table, whose kernel takes a quarter of a second to compile and run.
gpu::Buffer albedoTableFor(gpu::Device& device, uint32_t features) {
    if ((features & (kFeatureSpecular | kFeatureGlass | kFeatureClearcoat | kFeatureSheen)) != 0)
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

GpuScene::GpuScene(gpu::Device& device, const SceneData& data)
    : bvhSeconds_(data.bvh.buildSeconds), nodes_(uploadTexels(device, "BVH nodes", data.bvh.nodes)),
      leafTriangles_(uploadTexels(device, "leaf triangles", data.leafTriangles)),
      normals_(uploadTexels(device, "triangle normals", data.normals)),
      materials_(uploadTexels(device, "materials", data.materials)),
      lights_(uploadTexels(device, "lights", data.lights)),
      punctuals_(uploadTexels(device, "punctual lights", data.punctuals)),
      lightTree_(uploadTexels(device, "light tree", data.lightTree)),
      albedoTable_(albedoTableFor(device, data.features)) {}

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
