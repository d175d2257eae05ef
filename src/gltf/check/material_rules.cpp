// Materials and what belongs to them.
#include "gltf/check/material_rules.h"

namespace lavalight {
namespace {

const std::string kMaterial = "materials[]";
const std::string kExtensions = "materials[].extensions.";

// The properties of a material extension that are numbers or colours, and its textures.
struct ExtensionRule {
    const char* name;
    std::vector<PropertyRule> properties;
    std::vector<const char*> textures;
};

PropertyRule number(std::string_view name) {
    return optional(name, Kind::number);
}

std::vector<ExtensionRule> extensionRules() {
    return {
        {"KHR_materials_emissive_strength", {number("emissiveStrength")}, {}},
        {"KHR_materials_specular",
         {number("specularFactor"), numbers("specularColorFactor", 3)},
         {"specularTexture", "specularColorTexture"}},
        {"KHR_materials_ior", {number("ior")}, {}},
        {"KHR_materials_transmission", {number("transmissionFactor")}, {"transmissionTexture"}},
        {"KHR_materials_volume",
         {number("thicknessFactor"), number("attenuationDistance"), numbers("attenuationColor", 3)},
         {"thicknessTexture"}},
        {"KHR_materials_dispersion", {number("dispersion")}, {}},
        {"KHR_materials_clearcoat",
         {number("clearcoatFactor"), number("clearcoatRoughnessFactor")},
         {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"}},
        {"KHR_materials_sheen",
         {numbers("sheenColorFactor", 3), number("sheenRoughnessFactor")},
         {"sheenColorTexture", "sheenRoughnessTexture"}},
        {"KHR_materials_anisotropy",
         {number("anisotropyStrength"), number("anisotropyRotation")},
         {"anisotropyTexture"}},
        {"KHR_materials_iridescence",
         {number("iridescenceFactor"), number("iridescenceIor"), number("iridescenceThicknessMinimum"),
          number("iridescenceThicknessMaximum")},
         {"iridescenceTexture", "iridescenceThicknessTexture"}},
        {"KHR_materials_diffuse_transmission",
         {number("diffuseTransmissionFactor"), numbers("diffuseTransmissionColorFactor", 3)},
         {"diffuseTransmissionTexture", "diffuseTransmissionColorTexture"}},
        {"KHR_materials_pbrSpecularGlossiness",
         {numbers("diffuseFactor", 4), numbers("specularFactor", 3), number("glossinessFactor")},
         {"diffuseTexture", "specularGlossinessTexture"}},
    };
}

void addTexture(std::vector<ObjectRule>& rules, const std::string& path) {
    rules.push_back({path,
                     {index("index", "textures", Need::required), optional("texCoord", Kind::small),
                      number("scale"), optional("extensions", Kind::object)}});
    rules.push_back(
        {path + ".extensions.KHR_texture_transform",
         {numbers("offset", 2), number("rotation"), numbers("scale", 2), optional("texCoord", Kind::small)}});
}

void addTextureRules(std::vector<ObjectRule>& rules) {
    rules.push_back({"textures[]",
                     {index("sampler", "samplers"), optional("source", Kind::count),
                      optional("extensions", Kind::object)}});
    rules.push_back({"textures[].extensions.EXT_texture_webp", {optional("source", Kind::count)}});
    rules.push_back({"samplers[]",
                     {optional("wrapS", Kind::small), optional("wrapT", Kind::small),
                      optional("magFilter", Kind::small), optional("minFilter", Kind::small)}});
    rules.push_back(
        {"images[]",
         {index("bufferView", "bufferViews"), optional("uri", Kind::text), optional("name", Kind::text)}});
}

void addVariantRules(std::vector<ObjectRule>& rules) {
    const char* variants = "extensions.KHR_materials_variants.variants";
    rules.push_back(
        {"extensions.KHR_materials_variants", {{"variants", Kind::object, Need::optional, kAnyLength}}});
    rules.push_back({"extensions.KHR_materials_variants.variants[]", {optional("name", Kind::text)}});
    rules.push_back({"meshes[].primitives[].extensions.KHR_materials_variants.mappings[]",
                     {index("material", "materials", Need::required),
                      {"variants", Kind::index, Need::required, kAnyLength, variants}}});
}

} // namespace

void addMaterialRules(std::vector<ObjectRule>& rules) {
    rules.push_back(
        {kMaterial,
         {optional("name", Kind::text), numbers("emissiveFactor", 3), optional("alphaMode", Kind::text),
          number("alphaCutoff"), optional("doubleSided", Kind::flag), optional("extensions", Kind::object)}});
    rules.push_back({kMaterial + ".pbrMetallicRoughness",
                     {numbers("baseColorFactor", 4), number("metallicFactor"), number("roughnessFactor")}});
    for (const char* texture :
         {".pbrMetallicRoughness.baseColorTexture", ".pbrMetallicRoughness.metallicRoughnessTexture",
          ".normalTexture", ".occlusionTexture", ".emissiveTexture"})
        addTexture(rules, kMaterial + texture);
    for (const ExtensionRule& extension : extensionRules()) {
        rules.push_back({kExtensions + extension.name, extension.properties});
        for (const char* texture : extension.textures)
            addTexture(rules, kExtensions + extension.name + "." + texture);
    }
    addTextureRules(rules);
    addVariantRules(rules);
}

} // namespace lavalight
