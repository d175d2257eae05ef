// KHR_materials_variants: other materials for the same meshes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <tiny_gltf.h>

namespace lavalight {

// The names of the file's variants.
[[nodiscard]] std::vector<std::string> readVariants(const nlohmann::json& json);

// The number of the variant that is asked for by name or number; none for an empty `wanted`. Throws
// UsageError with the names that there are.
[[nodiscard]] std::optional<int> findVariant(const std::vector<std::string>& variants,
                                             const std::string& wanted, const std::string& source);

// The material of a primitive in that variant; -1: the default.
[[nodiscard]] int materialOf(const tinygltf::Primitive& primitive, std::optional<int> variant);

} // namespace lavalight
