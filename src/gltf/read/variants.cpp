// Material variants.
#include "gltf/read/variants.h"

#include <nlohmann/json.hpp>

#include "base/named.h"
#include "gltf/read/notes.h"

namespace lavalight {
namespace {

constexpr const char* kExtension = "KHR_materials_variants";

} // namespace

std::vector<std::string> readVariants(const nlohmann::json& json) {
    std::vector<std::string> names;
    const auto extensions = json.find("extensions");
    if (extensions == json.end() || !extensions->contains(kExtension))
        return names;
    for (const nlohmann::json& variant :
         extensions->at(kExtension).value("variants", nlohmann::json::array()))
        names.push_back(printable(variant.value("name", std::string())));
    return names;
}

std::optional<int> findVariant(const std::vector<std::string>& variants, const std::string& wanted,
                               const std::string& source) {
    if (wanted.empty())
        return std::nullopt;
    return static_cast<int>(findNamed(variants, {wanted, "--variant", "variant", source}));
}

int materialOf(const tinygltf::Primitive& primitive, std::optional<int> variant) {
    const auto extension = primitive.extensions.find(kExtension);
    if (!variant || extension == primitive.extensions.end() || !extension->second.Has("mappings"))
        return primitive.material;
    const tinygltf::Value& mappings = extension->second.Get("mappings");
    for (size_t i = 0; i < mappings.ArrayLen(); ++i) {
        const tinygltf::Value& mapping = mappings.Get(static_cast<int>(i));
        const tinygltf::Value& variants = mapping.Get("variants");
        for (size_t k = 0; k < variants.ArrayLen(); ++k)
            if (variants.Get(static_cast<int>(k)).GetNumberAsInt() == *variant)
                return mapping.Get("material").GetNumberAsInt();
    }
    return primitive.material;
}

} // namespace lavalight
