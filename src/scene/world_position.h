// Places as people write and read them: in the world of the file, from whose origin the scene's own may be
// far.
#pragma once

#include <string>

#include <fmt/format.h>
#include <glm/glm.hpp>

namespace lavalight {

[[nodiscard]] inline glm::dvec3 toWorld(const glm::vec3& position, const glm::dvec3& origin) {
    return origin + glm::dvec3(position);
}

[[nodiscard]] inline glm::vec3 fromWorld(const glm::dvec3& place, const glm::dvec3& origin) {
    return glm::vec3(place - origin);
}

// One coordinate in the world with `digits` digits, or with more where the origin takes digits away.
[[nodiscard]] inline std::string worldText(float coordinate, double origin, int digits) {
    constexpr int kFarDigits = 12; // tenths of a millimetre at 10,000 km
    return fmt::format("{:.{}g}", origin + double{coordinate}, origin == 0.0 ? digits : kFarDigits);
}

// "X,Y,Z" in the world, with all the digits that bring the position back.
[[nodiscard]] inline std::string worldText(const glm::vec3& position, const glm::dvec3& origin) {
    std::string text;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        text += (axis > 0 ? "," : "") + (origin[axis] == 0.0
                                             ? fmt::format("{}", position[axis])
                                             : fmt::format("{}", origin[axis] + double{position[axis]}));
    return text;
}

} // namespace lavalight
