#include "device_scene/gpu_scene.h"

#include "device_scene/albedo_table.h"
#include "device_scene/gpu_lights.h"
#include "device_scene/upload.h"

namespace lavalight {
namespace {

// Lambert surfaces and mirrors never look into the table, whose kernel takes a
// quarter of a second to compile and run.
AlbedoTable albedoTableFor(gpu::Device& device, SceneFeatures features, const KernelSource& source) {
    const bool hasCoats = (features & (kFeatureSpecular | kFeatureClearcoat)) != 0;
    if ((hasCoats && (features & kFeatureRoughLobes) != 0) || (features & kFeatureSheen) != 0)
        return makeAlbedoTable(device, source("albedo"));
    return {{device, "albedo table", 0, gpu::BufferUse::texels}, {}};
}

std::vector<LightRecord> lightsInRecords(const SceneData& data) {
    return inRecords(data.lights, data.accelerator.recordsOfTriangles(data.triangles.size()));
}

} // namespace

GpuScene::GpuScene(gpu::Device& device, const SceneData& data, const KernelSource& source)
    : features_(data.features), fingerprints_(fingerprintsOf(data)),
      accelerator_(device, data.accelerator, data.triangles),
      normals_(uploadTexels(device, "triangle normals", data.normals)),
      materials_(uploadTexels(device, "materials", data.materials)),
      solids_(uploadTexels(device, "solids", data.solids)),
      lights_(uploadTexels(device, "lights", lightsInRecords(data))),
      punctuals_(uploadTexels(device, "punctual lights", data.punctuals)),
      lightTree_(uploadTexels(device, "light tree", data.lightTree)),
      pictures_(uploadTexels(device, "pictures", data.textures.pictures)),
      textures_(uploadTexels(device, "textures", data.textures.records)),
      uvs_(uploadTexels(device, "texture coordinates", data.uvs)),
      colors_(uploadTexels(device, "vertex colours", data.colors)),
      tangents_(uploadTexels(device, "tangents", data.tangents)),
      environmentMap_(uploadTexels(device, "environment map", data.environmentMap)),
      environmentQuads_(uploadTexels(device, "environment quads", data.environmentQuads)),
      albedoTable_(albedoTableFor(device, data.features, source)) {}

void GpuScene::addTo(gpu::ResourceTable& resources) const {
    accelerator_.addTo(resources);
    resources.set("triangleNormals", normals_);
    resources.set("materials", materials_);
    resources.set("solids", solids_);
    resources.set("lights", lights_);
    resources.set("punctuals", punctuals_);
    resources.set("lightTree", lightTree_);
    resources.set("pictures", pictures_);
    resources.set("textures", textures_);
    resources.set("triangleUvs", uvs_);
    resources.set("triangleColors", colors_);
    resources.set("triangleTangents", tangents_);
    resources.set("environmentMap", environmentMap_);
    resources.set("environmentQuads", environmentQuads_);
    resources.set("albedoTable", albedoTable_.buffer);
}

uint64_t GpuScene::bytes() const {
    return accelerator_.bytes() + normals_.bytes() + materials_.bytes() + solids_.bytes() + lights_.bytes() +
           punctuals_.bytes() + lightTree_.bytes() + pictures_.bytes() + textures_.bytes() + uvs_.bytes() +
           colors_.bytes() + tangents_.bytes() + environmentMap_.bytes() + environmentQuads_.bytes() +
           albedoTable_.buffer.bytes();
}

} // namespace lavalight
