// Metallic-roughness materials (glTF 2.0 specification, section 3.9) and what their extensions add.
#include "gltf/read/material.h"

#include <string>

#include "gltf/read/extension_reader.h"
#include "gltf/read/factors.h"
#include "gltf/read/material_extensions.h"

namespace lavalight {
namespace {

void setTexture(Material& material, TextureSlot slot, const std::optional<Texture>& texture) {
    material.textures[static_cast<size_t>(slot)] = texture;
}

void readBase(JsonView source, const std::vector<GltfTexture>& textures, Material& material,
              FactorReader& factors) {
    const JsonView pbr = source["pbrMetallicRoughness"];
    const glm::dvec4 baseColor = pbr.vector<4>("baseColorFactor", glm::dvec4(1.0));
    material.baseColor = factors.clamped(glm::dvec3(baseColor), 1.0, "baseColorFactor");
    material.alpha = factors.clamped(baseColor.w, 0.0, 1.0, "baseColorFactor");
    material.metallic = factors.clamped(pbr.number("metallicFactor", 1.0), 0.0, 1.0, "metallicFactor");
    material.roughness = factors.clamped(pbr.number("roughnessFactor", 1.0), 0.0, 1.0, "roughnessFactor");
    setTexture(material, TextureSlot::baseColor, makeTexture(textures, pbr["baseColorTexture"], true));
    setTexture(material, TextureSlot::metallicRoughness,
               makeTexture(textures, pbr["metallicRoughnessTexture"], false));
}

void readNormals(JsonView source, const std::vector<GltfTexture>& textures, Material& material) {
    setTexture(material, TextureSlot::normal, makeTexture(textures, source["normalTexture"], false));
    material.normalScale = static_cast<float>(source["normalTexture"].number("scale", 1.0));
}

glm::dvec3 emissiveFactor(JsonView source) {
    return source.vector<3>("emissiveFactor", glm::dvec3(0.0));
}

void readEmission(JsonView source, const std::vector<GltfTexture>& textures, Material& material,
                  FactorReader& factors) {
    const double strength =
        source["extensions"]["KHR_materials_emissive_strength"].number("emissiveStrength", 1.0);
    material.emission = factors.clamped(strength * emissiveFactor(source), kLargestFactor, "emission");
    if (material.emission != glm::vec3(0.0f))
        setTexture(material, TextureSlot::emission, makeTexture(textures, source["emissiveTexture"], true));
}

void readAlpha(JsonView source, Material& material) {
    const std::string& mode = source.text("alphaMode");
    material.alphaMode = mode == "MASK"    ? AlphaMode::mask
                         : mode == "BLEND" ? AlphaMode::blend
                                           : AlphaMode::opaque;
    material.alphaCutoff = static_cast<float>(source.number("alphaCutoff", 0.5));
}

// Leaves an unlit surface its base colour alone.
void leaveUnlit(Material& material) {
    material.emission = glm::vec3(0.0f);
    for (size_t slot = 0; slot < kTextureSlots; ++slot)
        if (slot != static_cast<size_t>(TextureSlot::baseColor))
            material.textures[slot].reset();
}

Material readMaterial(JsonView source, size_t index, const GltfDocument& document, GltfNotes& notes) {
    const std::string name = describe("material", index, source.text("name"));
    FactorReader factors(name, notes);
    Material material;
    material.name = printable(source.text("name"));
    material.doubleSided = source.flag("doubleSided", false);
    const std::vector<GltfTexture>& textures = document.textures;
    readBase(source, textures, material, factors);
    readAlpha(source, material);
    for (const auto& [extension, value] : source["extensions"].members()) {
        if (!value.is_object())
            continue;
        ExtensionReader reader(value, textures, material, factors);
        readMaterialExtension(extension, reader);
    }
    readNormals(source, textures, material);
    readEmission(source, textures, material, factors);
    if (glm::any(glm::greaterThan(emissiveFactor(source), glm::dvec3(1.0))))
        notes.addObject("emissiveFactor above 1 was taken as it is", name);
    if (material.isUnlit)
        leaveUnlit(material);
    return material;
}

} // namespace

std::vector<Material> readMaterials(const GltfDocument& document, GltfNotes& notes) {
    std::vector<Material> materials;
    for (const JsonView source : document.list("materials").elements())
        materials.push_back(readMaterial(source, materials.size(), document, notes));
    Material fallback;
    fallback.name = "default";
    materials.push_back(fallback);
    return materials;
}

} // namespace lavalight
