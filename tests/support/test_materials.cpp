#include "support/test_materials.h"

#include <fmt/format.h>

#include "device_scene/albedo_table.h"
#include "kernels/kernel_source.h"

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

MaterialRecord clearcoated(MaterialRecord record, float clearcoat, float roughness) {
    record.clearcoat = clearcoat;
    record.clearcoatRoughness = roughness;
    return record;
}

MaterialRecord withTiltedCoat(MaterialRecord record) {
    record.clearcoatNormalScale = 0.3f;
    return record;
}

MaterialRecord withSheen(MaterialRecord record, const glm::vec3& color, float roughness) {
    record.sheenColor = color;
    record.sheenRoughness = roughness;
    return record;
}

MaterialRecord anisotropic(MaterialRecord record, float strength) {
    record.anisotropy = strength;
    return record;
}

MaterialRecord withFilm(MaterialRecord record, float ior, float thickness) {
    record.iridescence = 1.0f;
    record.iridescenceIor = ior;
    record.iridescenceThicknessMaximum = thickness;
    return record;
}

MaterialRecord glass(float roughness, bool isSolid) {
    MaterialRecord record = dielectric(glm::vec3(1.0f), roughness);
    record.transmission = 1.0f;
    record.flags = isSolid ? kMaterialSolid : 0u;
    return record;
}

MaterialRecord leaf(const glm::vec3& reflected, const glm::vec3& transmitted) {
    MaterialRecord record = dielectric(reflected, 0.4f);
    record.diffuseTransmission = 0.6f;
    record.diffuseTransmissionColor = transmitted;
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

std::vector<TestMaterial> layeredMaterials() {
    const glm::vec3 white(1.0f);
    const glm::vec3 gold(1.0f, 0.766f, 0.336f);
    const MaterialRecord plain = dielectric(white, 0.5f);
    return {{"anisotropic gold", anisotropic(metal(gold, 0.3f), 0.6f)},
            {"anisotropic white dielectric", anisotropic(dielectric(white, 0.3f), 1.0f)},
            {"anisotropic rough white", anisotropic(plain, 0.5f)},
            {"clearcoat 0.4 over white dielectric", clearcoated(plain, 1.0f, 0.4f)},
            {"half a clearcoat over white metal", clearcoated(metal(white, 0.3f), 0.5f, 0.6f)},
            {"white sheen 0.3 over white", withSheen(lambert(white), white, 0.3f)},
            {"white sheen 0.15 over white", withSheen(lambert(white), white, 0.15f)},
            {"white sheen 0.1 over black", withSheen(lambert(glm::vec3(0.0f)), white, 0.1f)},
            {"white sheen 1 over white dielectric", withSheen(plain, white, 1.0f)},
            {"coloured sheen over gold", withSheen(metal(gold, 0.4f), {0.9f, 0.1f, 0.4f}, 0.5f)},
            {"clearcoat, sheen, white", clearcoated(withSheen(plain, {0.5f, 0.8f, 1.0f}, 0.4f), 1.0f, 0.3f)},
            {"film over white dielectric", withFilm(dielectric(white, 0.3f), 1.8f, 500.0f)},
            {"film over rough white dielectric", withFilm(dielectric(white, 1.0f), 1.3f, 300.0f)},
            {"film over white metal", withFilm(metal(white, 0.3f), 1.5f, 400.0f)},
            {"film over gold", withFilm(metal(gold, 0.5f), 2.0f, 250.0f)},
            {"film over white half metal", withFilm(halfMetal(white, 0.4f), 1.6f, 350.0f)}};
}

std::vector<TestMaterial> tiltedCoats() {
    const glm::vec3 white(1.0f);
    return {{"tilted coat over white dielectric",
             withTiltedCoat(clearcoated(dielectric(white, 0.5f), 1.0f, 0.6f))},
            {"tilted coat over white metal", withTiltedCoat(clearcoated(metal(white, 0.4f), 0.7f, 0.5f))}};
}

std::vector<TestMaterial> transmissiveMaterials() {
    const glm::vec3 white(1.0f);
    return {{"leaf", leaf(white, {1.0f, 0.6f, 0.2f})},
            {"leaf under sheen and clearcoat",
             clearcoated(withSheen(leaf(white, white), {0.7f, 0.5f, 0.5f}, 0.5f), 0.8f, 0.5f)},
            {"rough pane", glass(0.4f, false)},
            {"rough pane with a film", withFilm(glass(0.4f, false), 1.8f, 400.0f)},
            {"rough pane, clearcoat", clearcoated(glass(0.4f, false), 1.0f, 0.3f)}};
}

std::vector<TestMaterial> solidMaterials() {
    return {{"rough solid", glass(0.4f, true)},
            {"rough solid with a film", withFilm(glass(0.5f, true), 1.4f, 500.0f)},
            {"anisotropic solid", anisotropic(glass(0.4f, true), 0.5f)}};
}

std::vector<TestMaterial> smoothLayers() {
    const glm::vec3 white(1.0f);
    MaterialRecord matched = withFilm(glass(0.5f, true), 1.4f, 500.0f); // only its film is a boundary
    matched.ior = 1.0f;
    return {{"smooth clearcoat over white dielectric", clearcoated(dielectric(white, 0.5f), 1.0f, 0.0f)},
            {"smooth clearcoat over white metal", clearcoated(metal(white, 0.4f), 1.0f, 0.0f)},
            {"rough clearcoat over smooth metal", clearcoated(metal(white, 0.0f), 1.0f, 0.4f)},
            {"film over a rough solid of index 1", matched},
            {"tilted smooth clearcoat", withTiltedCoat(clearcoated(dielectric(white, 0.4f), 1.0f, 0.0f))},
            {"smooth pane, rough clearcoat", clearcoated(glass(0.0f, false), 1.0f, 0.5f)},
            {"sheen over smooth white dielectric", withSheen(dielectric(white, 0.0f), white, 0.5f)}};
}

std::vector<TestMaterial> smoothFilms() {
    const glm::vec3 white(1.0f);
    return {{"film over smooth white metal", withFilm(metal(white, 0.0f), 1.5f, 400.0f)},
            {"film over smooth pane", withFilm(glass(0.0f, false), 1.8f, 300.0f)},
            {"film over smooth solid", withFilm(glass(0.0f, true), 1.3f, 600.0f)}};
}

std::vector<TestMaterial> whitesOfAllRoughnesses() {
    const glm::vec3 white(1.0f);
    std::vector<TestMaterial> whites;
    const auto add = [&](const char* name, float roughness, const MaterialRecord& record) {
        whites.push_back({fmt::format("{}, roughness {}", name, roughness), record});
    };
    for (const float roughness : {0.02f, 0.033f, 0.06f, 0.17f, 0.63f}) {
        add("white dielectric", roughness, dielectric(white, roughness));
        add("white metal", roughness, metal(white, roughness));
        add("clearcoat over white metal", roughness, clearcoated(metal(white, 0.0f), 1.0f, roughness));
        add("white sheen over white", roughness, withSheen(lambert(white), white, roughness));
        add("anisotropic white dielectric", roughness, anisotropic(dielectric(white, roughness), 0.3f));
    }
    return whites;
}

MaterialBuffers::MaterialBuffers(gpu::Device& device, std::span<const TestMaterial> materials)
    : records_(uploadRecords(device, materials)),
      albedoTable_(makeAlbedoTable(device, embeddedKernel("albedo")).buffer) {}

gpu::ResourceTable MaterialBuffers::resources() const {
    gpu::ResourceTable table;
    table.set("materials", records_);
    table.set("albedoTable", albedoTable_);
    return table;
}

} // namespace lavalight::test
