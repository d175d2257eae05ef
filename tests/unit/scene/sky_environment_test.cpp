// The sky against the model's values, and its sun.
#include "scene/procedural/sky_environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/error.h"

namespace lavalight {
namespace {

using std::numbers::pi;

constexpr double kUnit = 0.025; // of the model's

glm::dvec3 texel(const EnvironmentMap& sky, const glm::dvec3& towards) {
    const glm::dvec3 d = glm::normalize(towards);
    const double u = 0.5 + std::atan2(d.z, d.x) / (2.0 * pi);
    const double v = std::acos(d.y) / pi;
    return glm::dvec3(
               sky.image.at(std::min(static_cast<uint32_t>(u * sky.image.width), sky.image.width - 1),
                            std::min(static_cast<uint32_t>(v * sky.image.height), sky.image.height - 1))) /
           kUnit;
}

// Values of another implementation of the paper's formula, on the same tables, at the middles of these
// texels.
TEST(SkyEnvironment, HasTheModelsRadiance) {
    struct Row {
        float elevation, turbidity;
        glm::dvec3 towards, radiance;
    };
    const std::vector<Row> rows{
        {45.0f, 3.0f, {0.01, 1, 0.01}, {2.56592, 4.46649, 9.01747}},
        {45.0f, 3.0f, {1, 0.3, 0.2}, {7.04903, 11.78198, 19.59028}},
        {45.0f, 3.0f, {0, 0.6, 1}, {17.46401, 21.40933, 26.78734}},
        {45.0f, 3.0f, {-0.5, 0.1, -1}, {14.02283, 20.60702, 27.59354}},
        {20.0f, 2.5f, {0.01, 1, 0.01}, {1.23472, 2.57543, 5.02272}},
        {20.0f, 2.5f, {1, 0.3, 0.2}, {5.52504, 8.93822, 12.82224}},
        {20.0f, 2.5f, {0, 0.6, 1}, {12.31246, 14.84369, 16.57528}},
        {20.0f, 2.5f, {-0.5, 0.1, -1}, {13.34063, 18.62482, 20.02732}},
        {70.0f, 6.0f, {0.01, 1, 0.01}, {17.46702, 19.33180, 22.95378}},
        {70.0f, 6.0f, {1, 0.3, 0.2}, {9.73488, 14.27986, 22.48347}},
        {70.0f, 6.0f, {0, 0.6, 1}, {12.67403, 16.80673, 23.82516}},
        {70.0f, 6.0f, {-0.5, 0.1, -1}, {14.01422, 18.70422, 25.39272}},
    };
    for (const Row& row : rows) {
        const EnvironmentMap sky =
            makeSky({.sunElevation = row.elevation, .sunAzimuth = 0.0f, .turbidity = row.turbidity});
        const glm::dvec3 seen = texel(sky, row.towards);
        for (glm::length_t c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], row.radiance[c], 0.002 * row.radiance[c]) << row.elevation << " " << c;
    }
}

TEST(SkyEnvironment, SunStandsWhereItIsToldAndReddensTowardsTheHorizon) {
    const EnvironmentMap noon = makeSky({.sunElevation = 60.0f, .sunAzimuth = 90.0f});
    ASSERT_TRUE(noon.sun);
    EXPECT_NEAR(noon.sun->direction.x, 0.5f, 1e-6f);
    EXPECT_NEAR(noon.sun->direction.y, std::sqrt(0.75f), 1e-6f);
    // 0.533 degrees across: 6.8e-5 sr (the mean distance of the Earth).
    EXPECT_NEAR(2.0 * pi * noon.sun->size, 6.8e-5, 0.02e-5);
    // 91,000 lx / 683 from the sun through air of turbidity 3, as in the paper's appendix without its minor
    // gases.
    const double green = noon.sun->radiance.y * 2.0 * pi * noon.sun->size / kUnit;
    EXPECT_NEAR(green, 133.0, 3.0);
    const EnvironmentMap evening = makeSky({.sunElevation = 5.0f});
    // Through 10.4 times the air overhead (Kasten 1965), 195 x 0.975 x exp(-10.4 (0.101 + 0.202)).
    EXPECT_NEAR(evening.sun->radiance.y * 2.0 * pi * evening.sun->size / kUnit, 8.4, 0.2);
    const auto redness = [](const EnvironmentMap& sky) { return sky.sun->radiance.x / sky.sun->radiance.z; };
    EXPECT_GT(redness(evening), 4.0f * redness(noon));
    EXPECT_GT(noon.sun->radiance.y, 5.0f * evening.sun->radiance.y);
}

// E = pi L / albedo of the ground, which the map holds below the horizon.
TEST(SkyEnvironment, GroundIsLitByItsSkyAndSun) {
    const EnvironmentMap sky = makeSky({.sunElevation = 45.0f});
    const double ofSun = sky.sun->radiance.y * 2.0 * pi * sky.sun->size * std::sin(pi / 4.0);
    double ofSky = 0.0;
    for (uint32_t y = 0; y < sky.image.height / 2; ++y) {
        const double theta = pi * (y + 0.5) / sky.image.height;
        for (uint32_t x = 0; x < sky.image.width; ++x)
            ofSky += sky.image.at(x, y).y * std::sin(theta) * std::cos(theta) * (pi / sky.image.height) *
                     (2.0 * pi / sky.image.width);
    }
    EXPECT_NEAR(sky.image.at(7, sky.image.height - 1).y * pi / 0.3, ofSun + ofSky, 1e-3 * ofSun);
    EXPECT_GT(ofSun, 2.0 * ofSky);
    EXPECT_NEAR(ofSun / std::sin(pi / 4.0) + ofSky, 3.7, 0.2); // about what the studio brings
}

TEST(SkyEnvironment, EveryTexelOfEverySkyIsFiniteAndNotNegative) {
    for (const float elevation : {0.0f, 1.0f, 30.0f, 90.0f})
        for (const float turbidity : {1.0f, 1.5f, 9.9f, 10.0f})
            for (const glm::vec3& texel :
                 makeSky({.sunElevation = elevation, .turbidity = turbidity}).image.pixels)
                for (glm::length_t c = 0; c < 3; ++c)
                    ASSERT_TRUE(std::isfinite(texel[c]) && texel[c] >= 0.0f) << elevation << " " << turbidity;
}

TEST(SkyEnvironment, SettingsOutOfRangeAreRefused) {
    EXPECT_THROW(static_cast<void>(makeSky({.sunElevation = -1.0f})), UsageError);
    EXPECT_THROW(static_cast<void>(makeSky({.sunElevation = 91.0f})), UsageError);
    EXPECT_THROW(static_cast<void>(makeSky({.turbidity = 0.5f})), UsageError);
    EXPECT_THROW(static_cast<void>(makeSky({.turbidity = std::nanf("")})), UsageError);
}

} // namespace
} // namespace lavalight
