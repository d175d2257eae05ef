// Metallic-roughness materials (glTF 2.0 specification, section 3.9) and what their extensions add.
#include "gltf/read/material.h"

#include <algorithm>
#include <string>

#include "gltf/read/extension_reader.h"
#include "gltf/read/factors.h"
#include "gltf/read/material_extensions.h"

namespace lavalight {
namespace {

void setTexture(Material& material, TextureSlot slot, std::optional<Texture> texture) {
    material.textures[static_cast<size_t>(slot)] = std::move(texture);
}

void readBase(const tinygltf::Material& source, const std::vector<GltfTexture>& textures, Material& material,
              FactorReader& factors) {
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    material.baseColor = factors.clamped(pbr.baseColorFactor, 1.0, "baseColorFactor");
    material.alpha = factors.clamped(pbr.baseColorFactor[3], 0.0, 1.0, "baseColorFactor");
    material.metallic = factors.clamped(pbr.metallicFactor, 0.0, 1.0, "metallicFactor");
    material.roughness = factors.clamped(pbr.roughnessFactor, 0.0, 1.0, "roughnessFactor");
    setTexture(material, TextureSlot::baseColor,
               makeTexture(textures, GltfTextureInfo(pbr.baseColorTexture), true));
    setTexture(material, TextureSlot::metallicRoughness,
               makeTexture(textures, GltfTextureInfo(pbr.metallicRoughnessTexture), false));
}

void readNormals(const tinygltf::Material& source, const std::vector<GltfTexture>& textures,
                 Material& material) {
    setTexture(material, TextureSlot::normal,
               makeTexture(textures, GltfTextureInfo(source.normalTexture), false));
    material.normalScale = static_cast<float>(source.normalTexture.scale);
}

void readEmission(const tinygltf::Material& source, const std::vector<GltfTexture>& textures,
                  Material& material, FactorReader& factors) {
    double strength = 1.0;
    const auto extension = source.extensions.find("KHR_materials_emissive_strength");
    if (extension != source.extensions.end() && extension->second.Has("emissiveStrength"))
        strength = extension->second.Get("emissiveStrength").GetNumberAsDouble();
    std::vector<double> emission;
    for (const double channel : source.emissiveFactor)
        emission.push_back(channel * strength);
    material.emission = factors.clamped(emission, kLargestFactor, "emission");
    if (material.emission != glm::vec3(0.0f))
        setTexture(material, TextureSlot::emission,
                   makeTexture(textures, GltfTextureInfo(source.emissiveTexture), true));
}

void readAlpha(const tinygltf::Material& source, Material& material) {
    material.alphaMode = source.alphaMode == "MASK"    ? AlphaMode::mask
                         : source.alphaMode == "BLEND" ? AlphaMode::blend
                                                       : AlphaMode::opaque;
    material.alphaCutoff = static_cast<float>(source.alphaCutoff);
}

// Of an unlit surface only the base colour counts.
void leaveUnlit(Material& material) {
    material.emission = glm::vec3(0.0f);
    for (size_t slot = 0; slot < kTextureSlots; ++slot)
        if (slot != static_cast<size_t>(TextureSlot::baseColor))
            material.textures[slot].reset();
}

Material readMaterial(const tinygltf::Material& source, size_t index, const GltfDocument& document,
                      GltfNotes& notes) {
    const std::string name = describe("material", index, source.name);
    FactorReader factors(name, notes);
    Material material;
    material.name = printable(source.name);
    material.doubleSided = source.doubleSided;
    const std::vector<GltfTexture>& textures = document.textures;
    readBase(source, textures, material, factors);
    readAlpha(source, material);
    for (const auto& [extension, value] : source.extensions) {
        ExtensionReader reader(value, textures, material, factors);
        readMaterialExtension(extension, reader);
    }
    readNormals(source, textures, material);
    readEmission(source, textures, material, factors);
    if (std::any_of(source.emissiveFactor.begin(), source.emissiveFactor.end(),
                    [](double channel) { return channel > 1.0; }))
        notes.addObject("emissiveFactor above 1 was taken as it is", name);
    if (material.isUnlit)
        leaveUnlit(material);
    return material;
}

} // namespace

std::vector<Material> readMaterials(const GltfDocument& document, GltfNotes& notes) {
    std::vector<Material> materials;
    for (const tinygltf::Material& source : document.model.materials)
        materials.push_back(readMaterial(source, materials.size(), document, notes));
    Material fallback;
    fallback.name = "default";
    materials.push_back(fallback);
    return materials;
}

} // namespace lavalight
