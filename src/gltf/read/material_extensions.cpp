// KHR_materials_*: from their properties to a Material.
#include "gltf/read/material_extensions.h"

#include <algorithm>
#include <array>
#include <utility>

#include "gltf/check/extensions.h"

namespace lavalight {
namespace {

void readSpecular(ExtensionReader& reader) {
    Material& m = reader.material();
    m.specular = reader.number("specularFactor", 1.0);
    m.specularColor = reader.color("specularColorFactor", glm::vec3(1.0f), kLargestFactor);
    reader.texture("specularTexture", TextureSlot::specular);
    reader.texture("specularColorTexture", TextureSlot::specularColor, true);
}

// An index of refraction of 0 is a value of its own: it makes F0 1, which older formats' conversions use.
void readIor(ExtensionReader& reader) {
    const float ior = reader.number("ior", 1.5, 0.0, kLargestFactor);
    reader.material().ior = ior == 0.0f ? 0.0f : reader.number("ior", 1.5, 1.0, kLargestFactor);
}

void readTransmission(ExtensionReader& reader) {
    reader.material().transmission = reader.number("transmissionFactor", 0.0);
    reader.texture("transmissionTexture", TextureSlot::transmission);
}

// The figure of the thickness is for renderers that do not trace rays; here it says which meshes are the
// boundaries of bodies.
void readVolume(ExtensionReader& reader) {
    Material& m = reader.material();
    m.isSolid = reader.number("thicknessFactor", 0.0, 0.0, kLargestFactor) > 0.0f;
    m.attenuationColor = reader.color("attenuationColor", glm::vec3(1.0f));
    if (reader.has("attenuationDistance"))
        m.attenuationDistance = reader.number("attenuationDistance", 1.0, 1e-15, kLargestFactor);
}

void readClearcoat(ExtensionReader& reader) {
    Material& m = reader.material();
    m.clearcoat = reader.number("clearcoatFactor", 0.0);
    m.clearcoatRoughness = reader.number("clearcoatRoughnessFactor", 0.0);
    m.clearcoatNormalScale = reader.normalScale("clearcoatNormalTexture");
    if (m.clearcoat == 0.0f)
        return;
    reader.texture("clearcoatTexture", TextureSlot::clearcoat);
    reader.texture("clearcoatRoughnessTexture", TextureSlot::clearcoatRoughness);
    reader.texture("clearcoatNormalTexture", TextureSlot::clearcoatNormal);
}

void readSheen(ExtensionReader& reader) {
    Material& m = reader.material();
    m.sheenColor = reader.color("sheenColorFactor", glm::vec3(0.0f));
    m.sheenRoughness = reader.number("sheenRoughnessFactor", 0.0);
    if (m.sheenColor == glm::vec3(0.0f))
        return;
    reader.texture("sheenColorTexture", TextureSlot::sheenColor, true);
    reader.texture("sheenRoughnessTexture", TextureSlot::sheenRoughness);
}

void readAnisotropy(ExtensionReader& reader) {
    Material& m = reader.material();
    m.anisotropy = reader.number("anisotropyStrength", 0.0);
    m.anisotropyRotation = reader.number("anisotropyRotation", 0.0, -kLargestFactor, kLargestFactor);
    if (m.anisotropy > 0.0f)
        reader.texture("anisotropyTexture", TextureSlot::anisotropy);
}

void readIridescence(ExtensionReader& reader) {
    Material& m = reader.material();
    m.iridescence = reader.number("iridescenceFactor", 0.0);
    m.iridescenceIor = reader.number("iridescenceIor", 1.3, 1.0, kLargestFactor);
    m.iridescenceThicknessMinimum = reader.number("iridescenceThicknessMinimum", 100.0, 0.0, kLargestFactor);
    m.iridescenceThicknessMaximum = reader.number("iridescenceThicknessMaximum", 400.0, 0.0, kLargestFactor);
    if (m.iridescence == 0.0f)
        return;
    reader.texture("iridescenceTexture", TextureSlot::iridescence);
    reader.texture("iridescenceThicknessTexture", TextureSlot::iridescenceThickness);
}

void readDispersion(ExtensionReader& reader) {
    reader.material().dispersion = reader.number("dispersion", 0.0, 0.0, kLargestFactor);
}

void readDiffuseTransmission(ExtensionReader& reader) {
    Material& m = reader.material();
    m.diffuseTransmission = reader.number("diffuseTransmissionFactor", 0.0);
    m.diffuseTransmissionColor =
        reader.color("diffuseTransmissionColorFactor", glm::vec3(1.0f), kLargestFactor);
    if (m.diffuseTransmission == 0.0f)
        return;
    reader.texture("diffuseTransmissionTexture", TextureSlot::diffuseTransmission);
    reader.texture("diffuseTransmissionColorTexture", TextureSlot::diffuseTransmissionColor, true);
}

// In KHR_materials_pbrSpecularGlossiness F0 is a colour of its own. An index of refraction of 0 makes the
// dielectric's F0 1 times specularColor, which is that. There are no metals.
void readSpecularGlossiness(ExtensionReader& reader) {
    Material& m = reader.material();
    m.baseColor = reader.color("diffuseFactor", glm::vec3(1.0f));
    m.metallic = 0.0f;
    m.ior = 0.0f;
    m.specular = 1.0f;
    m.specularColor = reader.color("specularFactor", glm::vec3(1.0f));
    m.roughness = 1.0f - reader.number("glossinessFactor", 1.0);
    m.isGlossiness = true;
    m.alpha = reader.alphaOf("diffuseFactor");
    m.textures[static_cast<size_t>(TextureSlot::metallicRoughness)].reset();
    reader.texture("diffuseTexture", TextureSlot::baseColor, true);
    reader.texture("specularGlossinessTexture", TextureSlot::specularColor, true);
}

void readUnlit(ExtensionReader& reader) {
    reader.material().isUnlit = true;
}

using Reader = void (*)(ExtensionReader&);
constexpr std::array<std::pair<std::string_view, Reader>, 12> kReaders = {{
    {"KHR_materials_anisotropy", readAnisotropy},
    {"KHR_materials_clearcoat", readClearcoat},
    {"KHR_materials_diffuse_transmission", readDiffuseTransmission},
    {"KHR_materials_dispersion", readDispersion},
    {"KHR_materials_ior", readIor},
    {"KHR_materials_iridescence", readIridescence},
    {"KHR_materials_pbrSpecularGlossiness", readSpecularGlossiness},
    {"KHR_materials_sheen", readSheen},
    {"KHR_materials_specular", readSpecular},
    {"KHR_materials_transmission", readTransmission},
    {"KHR_materials_unlit", readUnlit},
    {"KHR_materials_volume", readVolume},
}};

constexpr Reader readerOf(std::string_view name) {
    for (const auto& [known, reader] : kReaders)
        if (known == name)
            return reader;
    return nullptr;
}

static_assert(std::all_of(kReaders.begin(), kReaders.end(),
                          [](const auto& entry) { return extensionNamed(entry.first) != nullptr; }),
              "each extension that is read needs a row in kExtensions");
// The factor of the emissive strength is read with the emission.
static_assert(std::all_of(kExtensions.begin(), kExtensions.end(),
                          [](const Extension& extension) {
                              return !extension.hasRules() || readerOf(extension.name) != nullptr ||
                                     extension.name == "KHR_materials_emissive_strength";
                          }),
              "each extension of materials in kExtensions needs a reader");

} // namespace

void readMaterialExtension(std::string_view name, ExtensionReader& reader) {
    if (const Reader read = readerOf(name))
        read(reader);
}

} // namespace lavalight
