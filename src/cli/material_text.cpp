// Materials in words.
#include "cli/material_text.h"

#include <array>

namespace lavalight {
namespace {

// Names by TextureSlot.
constexpr std::array<const char*, kTextureSlots> kSlotNames = {"baseColor",
                                                               "metallicRoughness",
                                                               "normal",
                                                               "emission",
                                                               "specular",
                                                               "specularColor",
                                                               "transmission",
                                                               "clearcoat",
                                                               "clearcoatRoughness",
                                                               "clearcoatNormal",
                                                               "sheenColor",
                                                               "sheenRoughness",
                                                               "anisotropy",
                                                               "iridescence",
                                                               "iridescenceThickness",
                                                               "diffuseTransmission",
                                                               "diffuseTransmissionColor"};

void addIf(bool condition, const char* name, std::vector<std::string>& names) {
    if (condition)
        names.emplace_back(name);
}

} // namespace

std::vector<std::string> lobeNames(const Material& m) {
    std::vector<std::string> names;
    if (m.isUnlit)
        return {"unlit"};
    const bool mayBeDielectric = m.metallic < 1.0f || m.texture(TextureSlot::metallicRoughness);
    const bool isGlass = mayBeDielectric && m.transmission > 0.0f;
    addIf(m.metallic > 0.0f, "metal", names);
    addIf(mayBeDielectric && m.transmission < 1.0f, "diffuse", names);
    addIf(mayBeDielectric && m.specular > 0.0f, "specular", names);
    addIf(isGlass, m.isSolid ? "glass" : "thin glass", names);
    addIf(isGlass && m.isSolid && m.attenuationDistance < kNoAttenuation, "attenuation", names);
    addIf(isGlass && m.isSolid && m.dispersion > 0.0f, "dispersion", names);
    addIf(m.diffuseTransmission > 0.0f, "diffuse transmission", names);
    addIf(m.anisotropy > 0.0f, "anisotropy", names);
    addIf(m.iridescence > 0.0f, "iridescence", names);
    addIf(m.sheenColor != glm::vec3(0.0f), "sheen", names);
    addIf(m.clearcoat > 0.0f, "clearcoat", names);
    addIf(m.emission != glm::vec3(0.0f), "emission", names);
    return names;
}

std::vector<std::string> textureNames(const Material& material) {
    std::vector<std::string> names;
    for (size_t slot = 0; slot < kTextureSlots; ++slot)
        addIf(material.textures[slot].has_value(), kSlotNames[slot], names);
    return names;
}

const char* alphaModeName(AlphaMode mode) {
    return mode == AlphaMode::opaque ? "opaque" : mode == AlphaMode::mask ? "mask" : "blend";
}

} // namespace lavalight
