// Coverage and what is seen behind a scene, in every schedule.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr glm::vec3 kBlue(0.1f, 0.2f, 1.0f);
constexpr uint32_t kSide = 32;
constexpr uint32_t kSamples = 64;

// A pane in front of the camera that covers the left half of the image.
Shape leftHalf(float z) {
    return rectangle({-10, 0, z}, {10, 0, 0}, {0, 10, 0});
}

Material withAlpha(float alpha) {
    Material material = lambert(glm::vec3(0.5f));
    material.alphaMode = AlphaMode::blend;
    material.alpha = alpha;
    return material;
}

SceneBuilder lit() {
    return SceneBuilder().environment(glm::vec3(1.0f)).camera(lookAtOrthographic({0, 0, 5}, {0, 0, 0}, 1.0f));
}

class BackgroundImage : public DeviceTest {
  protected:
    [[nodiscard]] RenderSettings settings(Schedule schedule, Background background) const {
        RenderSettings settings = imageSettings(kSide, kSide, kSamples);
        settings.work.schedule = schedule;
        settings.background = {background, kBlue};
        return settings;
    }
    [[nodiscard]] Rendering render(const Scene& scene, Schedule schedule, Background background) {
        return renderScene(device(), scene, settings(schedule, background)).rendering;
    }
    // Mean coverage of the left and of the right half.
    [[nodiscard]] std::pair<double, double> coverages(const Scene& scene, Schedule schedule) {
        const Rendering image = render(scene, schedule, Background::transparent);
        const Layer* coverage = image.find("coverage");
        EXPECT_NE(coverage, nullptr);
        std::pair<double, double> means;
        for (uint32_t y = 0; y < kSide; ++y)
            for (uint32_t x = 0; x < kSide; ++x)
                (x < kSide / 2 ? means.first : means.second) +=
                    coverage->mean.at(x, y).x / (0.5 * kSide * kSide);
        return means;
    }
};

TEST_F(BackgroundImage, CoverageIsTheShareOfCameraPathsThatSomethingStops) {
    // Half a pixel's width more than the left half: the edge runs through the middle of a column.
    const Shape half = rectangle({-10 + 1.0f / kSide, 0, 0}, {10, 0, 0}, {0, 10, 0});
    const Scene opaque = lit().add(half, lambert(glm::vec3(0.5f))).build();
    const Scene quarter = lit().add(leftHalf(0), withAlpha(0.25f)).build();
    const Scene twoPanes =
        lit().add(leftHalf(0), withAlpha(0.25f)).add(leftHalf(-1), withAlpha(0.5f)).build();
    constexpr double kPaths = kSide * kSide / 2.0 * kSamples;
    for (const Schedule schedule : schedulesOf(device())) {
        SCOPED_TRACE(static_cast<int>(schedule));
        const auto edge = coverages(opaque, schedule);
        EXPECT_EQ(edge.first, 1.0);
        EXPECT_NEAR(edge.second, 0.5 / (kSide / 2), 1e-3);
        const auto expectShare = [&](const Scene& scene, double share) {
            const auto means = coverages(scene, schedule);
            EXPECT_NEAR(means.first, share, kSigmas * std::sqrt(share * (1.0 - share) / kPaths));
            EXPECT_EQ(means.second, 0.0);
        };
        expectShare(quarter, 0.25);
        expectShare(twoPanes, 1.0 - 0.75 * 0.5);
    }
}

TEST_F(BackgroundImage, ColourAndWhatIsLeftOpenOfABackgroundAreTheRenderBeforeIt) {
    const Scene scene = lit()
                            .add(ball({-0.4f, 0, 0}, 0.5f), lambert({0.7f, 0.3f, 0.2f}))
                            .add(rectangle({0.4f, 0, 1}, {0.4f, 0, 0}, {0, 0.4f, 0}), withAlpha(0.3f))
                            .build();
    for (const Schedule schedule : schedulesOf(device())) {
        SCOPED_TRACE(static_cast<int>(schedule));
        const Rendering open = render(scene, schedule, Background::transparent);
        const Rendering blue = render(scene, schedule, Background::constant);
        EXPECT_EQ(blue.find("coverage"), nullptr);
        double partly = 0.0;
        for (size_t i = 0; i < open.radiance().pixels.size(); ++i) {
            const float alpha = open.find("coverage")->mean.pixels[i].x;
            const glm::vec3 composed = open.radiance().pixels[i] + (1.0f - alpha) * kBlue;
            for (glm::length_t c = 0; c < 3; ++c)
                ASSERT_NEAR(composed[c], blue.radiance().pixels[i][c], 2e-6f) << i;
            partly += alpha > 0.0f && alpha < 1.0f ? 1.0 : 0.0;
        }
        EXPECT_GT(partly, 50.0); // so that there is something to compose
    }
}

// Nothing of the scene changes but what camera rays see directly.
TEST_F(BackgroundImage, WhatIsCoveredLooksAsBeforeTheEnvironmentAndGlassShowsIt) {
    Material glass = lambert(glm::vec3(1.0f));
    glass.transmission = 1.0f;
    glass.roughness = 0.0f;
    glass.specular = 1.0f;
    const Scene scene = lit().add(leftHalf(0), glass).build();
    for (const Schedule schedule : schedulesOf(device())) {
        SCOPED_TRACE(static_cast<int>(schedule));
        const Rendering plain = render(scene, schedule, Background::environment);
        const Rendering open = render(scene, schedule, Background::transparent);
        for (uint32_t y = 0; y < kSide; ++y)
            for (uint32_t x = 0; x < kSide; ++x) {
                const bool isLeft = x < kSide / 2;
                ASSERT_EQ(open.find("coverage")->mean.at(x, y).x, isLeft ? 1.0f : 0.0f);
                ASSERT_EQ(open.radiance().at(x, y), isLeft ? plain.radiance().at(x, y) : glm::vec3(0.0f));
            }
        EXPECT_GT(open.radiance().at(0, 0).r, 0.9f); // the environment through the pane
    }
}

TEST_F(BackgroundImage, DarkScenesHaveABackgroundToo) {
    const Scene dark = SceneBuilder()
                           .add(leftHalf(0), light(glm::vec3(2.0f)))
                           .camera(lookAtOrthographic({0, 0, 5}, {0, 0, 0}, 1.0f))
                           .build();
    for (const Schedule schedule : schedulesOf(device())) {
        const Rendering image = render(dark, schedule, Background::constant);
        EXPECT_EQ(image.radiance().at(0, 0), glm::vec3(2.0f));
        EXPECT_EQ(image.radiance().at(kSide - 1, 0), kBlue);
    }
}

} // namespace
} // namespace lavalight::test
