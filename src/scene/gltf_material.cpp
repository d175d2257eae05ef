// Metallic-roughness materials (glTF 2.0 specification, section 3.9) with KHR_materials_emissive_strength,
// KHR_materials_specular, KHR_materials_ior, KHR_materials_transmission and, but for its attenuation,
// KHR_materials_volume.
#include "scene/gltf_material.h"

#include <algorithm>
#include <string>

#include "scene/gltf_factors.h"

namespace lavalight {
namespace {

double numberIn(const tinygltf::Value& extension, const char* member, double otherwise) {
    return extension.Has(member) ? extension.Get(member).GetNumberAsDouble() : otherwise;
}

const tinygltf::Value* findExtension(const tinygltf::Material& source, const char* name) {
    const auto found = source.extensions.find(name);
    return found == source.extensions.end() ? nullptr : &found->second;
}

// White where there is none.
glm::vec3 colorIn(const tinygltf::Value& extension, const char* member, double largest,
                  FactorReader& factors) {
    if (!extension.Has(member))
        return glm::vec3(1.0f);
    std::vector<double> values;
    for (int i = 0; i < 3; ++i)
        values.push_back(extension.Get(member).Get(i).GetNumberAsDouble());
    return factors.clamped(values, largest, member);
}

void readSpecular(const tinygltf::Value& extension, Material& material, FactorReader& factors) {
    material.specular =
        factors.clamped(numberIn(extension, "specularFactor", 1.0), 0.0, 1.0, "specularFactor");
    material.specularColor = colorIn(extension, "specularColorFactor", kLargestFactor, factors);
}

// An index of refraction of 0 is a value of its own: it makes F0 1, which older formats' conversions use.
void readIor(const tinygltf::Value& extension, Material& material, FactorReader& factors) {
    const double ior = numberIn(extension, "ior", 1.5);
    material.ior = ior == 0.0 ? 0.0f : factors.clamped(ior, 1.0, kLargestFactor, "ior");
}

void readTransmission(const tinygltf::Value& extension, Material& material, FactorReader& factors) {
    material.transmission =
        factors.clamped(numberIn(extension, "transmissionFactor", 0.0), 0.0, 1.0, "transmissionFactor");
}

// The figure of the thickness is for renderers that do not trace rays; here it says which meshes are the
// boundaries of bodies, and these may attenuate.
void readVolume(const tinygltf::Value& extension, const std::string& name, Material& material,
                GltfNotes& notes) {
    FactorReader factors(name, notes);
    const double thickness = numberIn(extension, "thicknessFactor", 0.0);
    material.isSolid = factors.clamped(thickness, 0.0, kLargestFactor, "thicknessFactor") > 0.0f;
    const glm::vec3 color = colorIn(extension, "attenuationColor", 1.0, factors);
    if (material.isSolid && extension.Has("attenuationDistance") && color != glm::vec3(1.0f))
        notes.addObject("attenuation is not read yet, these materials are shown clear", name);
}

void readEmission(const tinygltf::Material& source, const std::string& name, Material& material,
                  GltfNotes& notes) {
    const auto& factor = source.emissiveFactor;
    if (source.emissiveTexture.index >= 0) {
        // The factor is mostly (1, 1, 1) then, and the texture mostly black: all of it would glow.
        notes.addObject("emission comes from a texture, which is not read yet, and was taken as black", name);
        return;
    }
    if (std::any_of(factor.begin(), factor.end(), [](double channel) { return channel > 1.0; }))
        notes.addObject("emissiveFactor above 1 was taken as it is", name);
    double strength = 1.0;
    if (const tinygltf::Value* extension = findExtension(source, "KHR_materials_emissive_strength"))
        strength = numberIn(*extension, "emissiveStrength", 1.0);
    std::vector<double> emission;
    for (const double channel : factor)
        emission.push_back(channel * strength);
    material.emission = FactorReader(name, notes).clamped(emission, kLargestFactor, "emission");
}

Material readMaterial(const tinygltf::Material& source, size_t index, GltfNotes& notes) {
    const std::string name = describe("material", index, source.name);
    FactorReader factors(name, notes);
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material material;
    material.name = printable(source.name);
    material.baseColor = factors.clamped(pbr.baseColorFactor, 1.0, "baseColorFactor");
    material.metallic = factors.clamped(pbr.metallicFactor, 0.0, 1.0, "metallicFactor");
    material.roughness = factors.clamped(pbr.roughnessFactor, 0.0, 1.0, "roughnessFactor");
    material.doubleSided = source.doubleSided;
    readEmission(source, name, material, notes);
    if (const tinygltf::Value* extension = findExtension(source, "KHR_materials_specular"))
        readSpecular(*extension, material, factors);
    if (const tinygltf::Value* extension = findExtension(source, "KHR_materials_ior"))
        readIor(*extension, material, factors);
    if (const tinygltf::Value* extension = findExtension(source, "KHR_materials_transmission"))
        readTransmission(*extension, material, factors);
    if (const tinygltf::Value* extension = findExtension(source, "KHR_materials_volume"))
        readVolume(*extension, name, material, notes);
    if (source.alphaMode != "OPAQUE")
        notes.addObject("alpha is not read yet, these materials are shown opaque", name);
    return material;
}

} // namespace

std::vector<Material> readMaterials(const GltfDocument& document, GltfNotes& notes) {
    std::vector<Material> materials;
    for (const tinygltf::Material& source : document.model.materials)
        materials.push_back(readMaterial(source, materials.size(), notes));
    Material fallback;
    fallback.name = "default";
    materials.push_back(fallback);
    return materials;
}

} // namespace lavalight
