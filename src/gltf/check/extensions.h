// The glTF extensions that are read: the one table of their names, and of the properties that materials'
// have.
#pragma once

#include <array>
#include <string_view>

#include "gltf/check/schema_rules.h"

namespace lavalight {

// An extension by its exact name. Unused places of the arrays have empty names.
struct Extension {
    std::string_view name;
    std::array<PropertyRule, 4> properties{};   // of a material's extension: its numbers and colours
    std::array<std::string_view, 3> textures{}; // of a material's extension: its textures

    [[nodiscard]] constexpr bool hasRules() const {
        return !properties.front().name.empty() || !textures.front().empty();
    }
};

namespace extension_table {

constexpr PropertyRule color(std::string_view name) {
    return numbers(name, 3);
}

} // namespace extension_table

// What these hold, no picture shows: KHR_xmp, KHR_xmp_json_ld (descriptions), KHR_interactivity,
// KHR_node_hoverability, KHR_node_selectability (what a viewer does), EXT_mesh_opacity_micromap (a faster way
// to the same alpha).
inline constexpr std::array kExtensions = [] {
    using namespace extension_table;
    return std::to_array<Extension>(
        {{"EXT_lights_image_based"},
         {"EXT_mesh_gpu_instancing"},
         {"EXT_mesh_opacity_micromap"},
         {"EXT_meshopt_compression"},
         {"EXT_texture_webp"},
         {"KHR_animation_pointer"},
         {"KHR_draco_mesh_compression"},
         {"KHR_interactivity"},
         {"KHR_lights_punctual"},
         {"KHR_materials_anisotropy",
          {number("anisotropyStrength"), number("anisotropyRotation")},
          {"anisotropyTexture"}},
         {"KHR_materials_clearcoat",
          {number("clearcoatFactor"), number("clearcoatRoughnessFactor")},
          {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"}},
         {"KHR_materials_diffuse_transmission",
          {number("diffuseTransmissionFactor"), color("diffuseTransmissionColorFactor")},
          {"diffuseTransmissionTexture", "diffuseTransmissionColorTexture"}},
         {"KHR_materials_dispersion", {number("dispersion")}},
         {"KHR_materials_emissive_strength", {number("emissiveStrength")}},
         {"KHR_materials_ior", {number("ior")}},
         {"KHR_materials_iridescence",
          {number("iridescenceFactor"), number("iridescenceIor"), number("iridescenceThicknessMinimum"),
           number("iridescenceThicknessMaximum")},
          {"iridescenceTexture", "iridescenceThicknessTexture"}},
         {"KHR_materials_pbrSpecularGlossiness",
          {numbers("diffuseFactor", 4), color("specularFactor"), number("glossinessFactor")},
          {"diffuseTexture", "specularGlossinessTexture"}},
         {"KHR_materials_sheen",
          {color("sheenColorFactor"), number("sheenRoughnessFactor")},
          {"sheenColorTexture", "sheenRoughnessTexture"}},
         {"KHR_materials_specular",
          {number("specularFactor"), color("specularColorFactor")},
          {"specularTexture", "specularColorTexture"}},
         {"KHR_materials_transmission", {number("transmissionFactor")}, {"transmissionTexture"}},
         {"KHR_materials_unlit"},
         {"KHR_materials_variants"},
         {"KHR_materials_volume",
          {number("thicknessFactor"), number("attenuationDistance"), color("attenuationColor")},
          {"thicknessTexture"}},
         {"KHR_mesh_quantization"},
         {"KHR_meshopt_compression"},
         {"KHR_node_hoverability"},
         {"KHR_node_selectability"},
         {"KHR_node_visibility"},
         {"KHR_texture_basisu"},
         {"KHR_texture_transform"},
         {"KHR_xmp"},
         {"KHR_xmp_json_ld"}});
}();

// The row of that exact name, or nullptr: the extension is not read.
[[nodiscard]] constexpr const Extension* extensionNamed(std::string_view name) {
    for (const Extension& extension : kExtensions)
        if (extension.name == name)
            return &extension;
    return nullptr;
}

// Whether the extension of that exact name is read by this build: an extension may need a library that is
// optional.
[[nodiscard]] bool isExtensionRead(std::string_view name);

} // namespace lavalight
