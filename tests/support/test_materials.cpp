#include "support/test_materials.h"

#include "render/albedo_table.h"

namespace lavalight::test {
namespace {

MaterialRecord dielectric(const glm::vec3& baseColor, float roughness, float ior = 1.5f) {
    MaterialRecord record{};
    record.baseColor = baseColor;
    record.roughness = roughness;
    record.specularColor = glm::vec3(1.0f);
    record.specular = 1.0f;
    record.ior = ior;
    return record;
}

MaterialRecord metal(const glm::vec3& baseColor, float roughness) {
    MaterialRecord record = dielectric(baseColor, roughness);
    record.metallic = 1.0f;
    return record;
}

MaterialRecord lambert(const glm::vec3& baseColor) {
    MaterialRecord record = dielectric(baseColor, 1.0f);
    record.specular = 0.0f;
    return record;
}

MaterialRecord halfMetal(const glm::vec3& baseColor, float roughness) {
    MaterialRecord record = dielectric(baseColor, roughness);
    record.metallic = 0.5f;
    return record;
}

MaterialRecord coated(const glm::vec3& baseColor, const glm::vec3& specularColor, float specular) {
    MaterialRecord record = dielectric(baseColor, 0.5f, 2.0f);
    record.specularColor = specularColor;
    record.specular = specular;
    return record;
}

MaterialRecord partlySpecular(float roughness) {
    MaterialRecord record = dielectric(glm::vec3(1.0f), roughness);
    record.specular = 0.4f;
    return record;
}

gpu::Buffer uploadRecords(gpu::Device& device, std::span<const TestMaterial> materials) {
    std::vector<MaterialRecord> records;
    for (const TestMaterial& material : materials)
        records.push_back(material.record);
    gpu::Buffer buffer(device, "test materials", records.size() * sizeof(MaterialRecord),
                       gpu::BufferUse::texels);
    buffer.upload(std::span<const MaterialRecord>(records));
    return buffer;
}

} // namespace

std::vector<TestMaterial> roughMaterials() {
    const glm::vec3 white(1.0f);
    return {{"white Lambert", lambert(white)},
            {"white dielectric, roughness 0.2", dielectric(white, 0.2f)},
            {"white dielectric, roughness 0.5", dielectric(white, 0.5f)},
            {"white dielectric, roughness 1", dielectric(white, 1.0f)},
            {"black dielectric, roughness 0.3", dielectric(glm::vec3(0.0f), 0.3f)},
            {"white, specular 0.4, roughness 0.4", partlySpecular(0.4f)},
            {"white, coloured specular", coated(white, {1.0f, 0.3f, 0.1f}, 0.8f)},
            {"white, specular colour beyond 1", coated(white, {20.0f, 1.0f, 0.0f}, 1.0f)},
            {"white, F0 = 1 (ior 0)", dielectric(white, 0.5f, 0.0f)},
            {"white metal, roughness 0.3", metal(white, 0.3f)},
            {"white metal, roughness 1", metal(white, 1.0f)},
            {"gold, roughness 0.3", metal({1.0f, 0.766f, 0.336f}, 0.3f)},
            {"half metal, roughness 0.6", halfMetal({0.8f, 0.3f, 0.1f}, 0.6f)}};
}

std::vector<TestMaterial> smoothMaterials() {
    const glm::vec3 white(1.0f);
    return {{"smooth gold", metal({1.0f, 0.766f, 0.336f}, 0.0f)},
            {"smooth white metal", metal(white, 0.0f)},
            {"smooth white dielectric", dielectric(white, 0.0f)},
            {"white dielectric, roughness 0.08", dielectric(white, 0.08f)},
            {"smooth white half metal", halfMetal(white, 0.0f)}};
}

MaterialBuffers::MaterialBuffers(gpu::Device& device, std::span<const TestMaterial> materials)
    : records_(uploadRecords(device, materials)), albedoTable_(makeAlbedoTable(device)) {}

gpu::ResourceTable MaterialBuffers::resources() const {
    gpu::ResourceTable table;
    table.set("materials", records_);
    table.set("albedoTable", albedoTable_);
    return table;
}

} // namespace lavalight::test
