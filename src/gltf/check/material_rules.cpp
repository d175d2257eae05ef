// Materials and what belongs to them.
#include "gltf/check/material_rules.h"

#include <fmt/format.h>

#include "gltf/check/extensions.h"

namespace lavalight {
namespace {

const std::string kMaterial = "materials[]";

void addTexture(std::vector<ObjectRule>& rules, const std::string& path) {
    rules.push_back({path,
                     {index("index", "textures", Need::required), optional("texCoord", Kind::small),
                      number("scale"), optional("extensions", Kind::object)}});
    rules.push_back(
        {path + ".extensions.KHR_texture_transform",
         {numbers("offset", 2), number("rotation"), numbers("scale", 2), optional("texCoord", Kind::small)}});
}

void addExtensionRules(std::vector<ObjectRule>& rules) {
    for (const Extension& extension : kExtensions) {
        if (!extension.hasRules())
            continue;
        const std::string path = fmt::format("{}.extensions.{}", kMaterial, extension.name);
        ObjectRule& rule = rules.emplace_back(ObjectRule{path, {}});
        for (const PropertyRule& property : extension.properties)
            if (!property.name.empty())
                rule.properties.push_back(property);
        for (const std::string_view texture : extension.textures)
            if (!texture.empty())
                addTexture(rules, fmt::format("{}.{}", path, texture));
    }
}

void addTextureRules(std::vector<ObjectRule>& rules) {
    rules.push_back({"textures[]",
                     {index("sampler", "samplers"), optional("source", Kind::count),
                      optional("extensions", Kind::object)}});
    for (const char* image :
         {"textures[].extensions.EXT_texture_webp", "textures[].extensions.KHR_texture_basisu"})
        rules.push_back({image, {optional("source", Kind::count)}});
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
    addExtensionRules(rules);
    addTextureRules(rules);
    addVariantRules(rules);
}

} // namespace lavalight
