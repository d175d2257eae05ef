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

std::optional<size_t> findVariant(const std::vector<std::string>& variants, const std::string& wanted,
                                  const std::string& source) {
    if (wanted.empty())
        return std::nullopt;
    return findNamed(variants, {wanted, "--variant", "variant", source});
}

std::optional<size_t> materialOf(JsonView primitive, std::optional<size_t> variant) {
    const JsonView mappings = primitive["extensions"][kExtension]["mappings"];
    for (const JsonView mapping : mappings.elements()) {
        for (const JsonView number : mapping["variants"].elements())
            if (variant && number.asCount(0) == *variant)
                return mapping.index("material");
    }
    return primitive.index("material");
}

} // namespace lavalight
