// A comparison as text and as JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "compare/comparison.h"

namespace lavalight {

[[nodiscard]] std::string comparisonText(const Comparison& comparison);

// Infinities and NaN, which JSON lacks, are null.
[[nodiscard]] nlohmann::ordered_json comparisonJson(const Comparison& comparison);

// What the files say of how they were made, where they differ: [{"key", "image", "reference"}], null for what
// one lacks.
[[nodiscard]] nlohmann::ordered_json metadataDifferences(const Metadata& image, const Metadata& reference);

} // namespace lavalight
