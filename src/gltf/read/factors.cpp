// Clamping of factors.
#include "gltf/read/factors.h"

#include <algorithm>

#include <fmt/format.h>

namespace lavalight {

float FactorReader::clamped(double value, double lower, double upper, const char* factor) {
    if (!(value >= lower && value <= upper))
        notes_.addObject(fmt::format("{} was clamped to {} .. {}", factor, lower, upper), name_);
    return static_cast<float>(std::clamp(value, lower, upper));
}

glm::vec3 FactorReader::clamped(const glm::dvec3& values, double upper, const char* factor) {
    glm::vec3 color;
    for (int i = 0; i < 3; ++i)
        color[i] = clamped(values[i], 0.0, upper, factor);
    return color;
}

} // namespace lavalight
