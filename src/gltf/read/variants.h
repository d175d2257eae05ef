// KHR_materials_variants: other materials for the same meshes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gltf/file/json_view.h"
namespace lavalight {

// The names of the file's variants.
[[nodiscard]] std::vector<std::string> readVariants(const nlohmann::json& json);

// The number of the variant that is asked for by name or number; none for an empty `wanted`. Throws
// UsageError with the names that there are.
[[nodiscard]] std::optional<size_t> findVariant(const std::vector<std::string>& variants,
                                                const std::string& wanted, const std::string& source);

// The material of a primitive in that variant; none: the default.
[[nodiscard]] std::optional<size_t> materialOf(JsonView primitive, std::optional<size_t> variant);

} // namespace lavalight
