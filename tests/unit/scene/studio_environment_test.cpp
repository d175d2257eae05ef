// The studio lights a model as its header promises.
#include "scene/procedural/studio_environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "image/srgb.h"

namespace lavalight {
namespace {

using std::numbers::pi;

// Direction of a texel's middle, and its solid angle.
glm::dvec3 directionOf(const Image& map, uint32_t x, uint32_t y) {
    const double theta = pi * (y + 0.5) / map.height;
    const double phi = 2.0 * pi * ((x + 0.5) / map.width - 0.5);
    return {std::cos(phi) * std::sin(theta), std::cos(theta), std::sin(phi) * std::sin(theta)};
}

double irradianceOn(const Image& map, const glm::dvec3& normal) {
    double sum = 0.0;
    for (uint32_t y = 0; y < map.height; ++y) {
        const double solidAngle =
            2.0 * pi / map.width * (std::cos(pi * y / map.height) - std::cos(pi * (y + 1) / map.height));
        for (uint32_t x = 0; x < map.width; ++x)
            sum += std::max(0.0, glm::dot(directionOf(map, x, y), normal)) * map.at(x, y).x * solidAngle;
    }
    return sum;
}

TEST(StudioEnvironment, LitSideOfALambertSurfaceOf018ShowsMiddleGreyWithAndWithoutTheNeutralCurve) {
    const Image map = makeStudio();
    double largest = 0.0; // the best of normals 3 degrees apart around the main light
    for (double pitch = 30.0; pitch < 90.0; pitch += 6.0)
        for (double yaw = 60.0; yaw < 200.0; yaw += 10.0) {
            const double p = pitch * pi / 180.0;
            const double a = yaw * pi / 180.0;
            largest = std::max(largest, irradianceOn(map, {std::cos(p) * std::cos(a), std::sin(p),
                                                           std::cos(p) * std::sin(a)}));
        }
    EXPECT_NEAR(largest, 3.7, 0.05);
    const double radiance = 0.18 * largest / pi;
    const double offset = 0.04; // that Khronos PBR Neutral takes from colours between 0.08 and 0.8
    for (const double shown : {radiance, radiance - offset}) {
        const double signal = encodeSrgb8(static_cast<float>(shown)) / 255.0;
        EXPECT_GE(signal, 0.45);
        EXPECT_LE(signal, 0.5);
    }
    EXPECT_GT(irradianceOn(map, {0, -1, 0}), 0.1 * largest); // nothing is black from below
}

TEST(StudioEnvironment, IsGreyAndBehindAModelThatIsSeenFromAboveThereIsNoBox) {
    const Image map = makeStudio();
    for (const glm::vec3& texel : map.pixels)
        ASSERT_TRUE(texel.x == texel.y && texel.y == texel.z && texel.x > 0.05f);
    const float box = 1.0f; // walls are darker, all boxes but the dim one brighter
    EXPECT_GT(std::ranges::count_if(map.pixels, [&](const glm::vec3& t) { return t.x > box; }), 2000);
    for (uint32_t y = map.height / 2 - 8; y < map.height; ++y) // from 3 degrees above the horizon down
        for (uint32_t x = 0; x < map.width; ++x)
            ASSERT_TRUE(directionOf(map, x, y).z >= 0.0 || map.at(x, y).x < box) << x << " " << y;
}

} // namespace
} // namespace lavalight
