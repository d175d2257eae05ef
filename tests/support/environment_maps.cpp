#include "support/environment_maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/random_numbers.h"

namespace lavalight::test {

using std::numbers::pi;

Image constantMap(uint32_t width, uint32_t height, const glm::vec3& radiance) {
    Image map(width, height);
    std::fill(map.pixels.begin(), map.pixels.end(), radiance);
    return map;
}

Image randomMap(uint32_t width, uint32_t height, uint32_t seed) {
    Random random(seed);
    Image map(width, height);
    for (glm::vec3& pixel : map.pixels) {
        pixel = {random.unit(), random.unit(), random.unit()};
        pixel *= random.unit() < 1.0f / 3.0f ? 0.0f : 1.0f;
    }
    return map;
}

Image sunMap(uint32_t width, uint32_t height, const glm::uvec2& sun, float radiance, float sky) {
    Image map = constantMap(width, height, glm::vec3(sky));
    map.pixels[size_t{sun.y} * width + sun.x] = glm::vec3(radiance);
    return map;
}

glm::dvec3 mapDirection(const glm::dvec2& uv) {
    const double phi = 2.0 * pi * (uv.x - 0.5);
    const double theta = pi * uv.y;
    return {std::cos(phi) * std::sin(theta), std::cos(theta), std::sin(phi) * std::sin(theta)};
}

glm::dvec2 mapPoint(const glm::dvec3& direction) {
    return {0.5 + std::atan2(direction.z, direction.x) / (2.0 * pi),
            std::acos(std::clamp(direction.y, -1.0, 1.0)) / pi};
}

glm::dvec3 mapLookup(const Image& map, const glm::dvec2& uv) {
    const double x = uv.x * map.width - 0.5;
    const double y = uv.y * map.height - 0.5;
    const double fx = x - std::floor(x);
    const double fy = y - std::floor(y);
    const auto at = [&](int64_t i, int64_t j) {
        const int64_t column = (i % map.width + map.width) % map.width;
        const int64_t row = std::clamp<int64_t>(j, 0, map.height - 1);
        return glm::dvec3(map.at(static_cast<uint32_t>(column), static_cast<uint32_t>(row)));
    };
    const auto i = static_cast<int64_t>(std::floor(x));
    const auto j = static_cast<int64_t>(std::floor(y));
    return glm::mix(glm::mix(at(i, j), at(i + 1, j), fx), glm::mix(at(i, j + 1), at(i + 1, j + 1), fx), fy);
}

} // namespace lavalight::test
