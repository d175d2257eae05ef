// Denoised pictures are nearer to the converged ones, and leave lamps alone.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "image/exr.h"
#include "session/builtin.h"
#include "session/denoised.h"
#include "support/environment_variable.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/temporary_folder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

class Denoise : public DeviceTest {
  protected:
    void SetUp() override {
        DeviceTest::SetUp();
        try {
            denoiser_ = std::make_unique<Denoiser>();
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
    }
    // A render of 16 samples, with the layer of light that is seen directly.
    [[nodiscard]] Rendering denoised(const Scene& scene, const Image& reference, DenoiseQuality quality) {
        RenderSettings settings = imageSettings(reference.width, reference.height, 16);
        settings.layers = kDenoisingLayers;
        Rendering rendering = renderScene(device(), scene, settings).rendering;
        denoise(rendering, *denoiser_, quality, 1u << kEmissionPlane, true);
        return rendering;
    }
    std::unique_ptr<Denoiser> denoiser_;
};

double meanOfAll(const Image& image) {
    double sum = 0.0;
    for (const glm::vec3& pixel : image.pixels)
        sum += pixel.x + pixel.y + pixel.z;
    return sum;
}

// Mean over the pixels without directly seen light, but for the worst in a thousand.
double relativeError(const Image& image, const Image& reference, const Image& emission) {
    std::vector<double> errors;
    for (size_t i = 0; i < image.pixels.size(); ++i)
        if (emission.pixels[i] == glm::vec3(0.0f)) {
            const glm::dvec3 r(reference.pixels[i]);
            const glm::dvec3 d = glm::dvec3(image.pixels[i]) - r;
            errors.push_back(glm::dot(d * d / (r * r + 0.01), glm::dvec3(1.0 / 3.0)));
        }
    std::sort(errors.begin(), errors.end());
    errors.resize(errors.size() - errors.size() / 1000);
    double sum = 0.0;
    for (const double error : errors)
        sum += error;
    return sum / static_cast<double>(errors.size());
}

TEST_F(Denoise, QuartersTheErrorOfSixteenSamplesAndKeepsTheMeanAndTheLamps) {
    for (const char* name : {"cornell-box", "many-lights", "veach-mis"}) {
        const Image reference = readExr(std::filesystem::path(LAVALIGHT_SOURCE_DIR) / "tests/references" /
                                        (std::string(name) + ".exr"))
                                    .radiance();
        for (const DenoiseQuality quality : {DenoiseQuality::high, DenoiseQuality::fast}) {
            SCOPED_TRACE(std::string(name) + " " + std::to_string(static_cast<int>(quality)));
            const Rendering rendering = denoised(loadScene(name), reference, quality);
            const Image& emission = rendering.find("emission")->mean;
            const Image& clean = rendering.find(kDenoisedLayer)->mean;
            EXPECT_EQ(rendering.find("guide-albedo"), nullptr); // nobody asked for it
            EXPECT_LT(relativeError(clean, reference, emission),
                      0.25 * relativeError(rendering.radiance(), reference, emission));
            EXPECT_NEAR(meanOfAll(clean) / meanOfAll(rendering.radiance()), 1.0, 0.02);
            double lamp = 0.0;
            double change = 0.0;
            for (size_t i = 0; i < clean.pixels.size(); ++i)
                if (emission.pixels[i].x > 1.0f) {
                    lamp += rendering.radiance().pixels[i].x;
                    change += std::abs(clean.pixels[i].x - rendering.radiance().pixels[i].x);
                }
            EXPECT_GT(lamp, 0.0);
            EXPECT_LT(change, 0.01 * lamp);
        }
    }
}

// Colour is denoised for what is covered, and has no glow around it.
TEST_F(Denoise, KeepsTheCoverageOfEdgesAndNothingWhereNothingIs) {
    RenderSettings settings = imageSettings(96, 96, 16);
    settings.layers = kDenoisingLayers;
    settings.background.kind = Background::transparent;
    const Scene scene = SceneBuilder()
                            .add(ball({0, 0, 0}, 1.0f), lambert({0.8f, 0.4f, 0.3f}))
                            .add(ball({0, 2.2f, 0.5f}, 1.0f), lambert(glm::vec3(0.1f)))
                            .environment(glm::vec3(1.0f))
                            .camera(lookAt({0.5f, 0.3f, 5}, {0, 0, 0}, 0.7f))
                            .build();
    const auto render = [&](uint32_t samples) {
        settings.stop.samples = samples;
        return renderScene(device(), scene, settings).rendering;
    };
    const Rendering reference = render(512);
    Rendering rendering = render(16);
    denoise(rendering, *denoiser_, DenoiseQuality::high, 0, true);
    const Image& clean = rendering.find(kDenoisedLayer)->mean;
    double edge = 0.0;
    double expected = 0.0;
    size_t open = 0;
    for (size_t i = 0; i < clean.pixels.size(); ++i) {
        const float alpha = reference.find("coverage")->mean.pixels[i].x;
        if (rendering.find(kDenoisedCoverage)->mean.pixels[i].x == 0.0f) {
            ASSERT_EQ(clean.pixels[i], glm::vec3(0.0f));
            ++open;
        }
        if (alpha > 0.0f && alpha < 1.0f) {
            edge += clean.pixels[i].y;
            expected += reference.radiance().pixels[i].y;
        }
    }
    EXPECT_GT(open, 1000u);
    EXPECT_NEAR(edge / expected, 1.0, 0.05);
}

// A pane that stops a quarter of the paths, by chance.
TEST_F(Denoise, SmoothsCoverageThatIsNoisyAndKeepsItsMean) {
    Material pane = lambert(glm::vec3(0.5f));
    pane.alphaMode = AlphaMode::blend;
    pane.alpha = 0.25f;
    RenderSettings settings = imageSettings(64, 64, 16);
    settings.layers = kDenoisingLayers;
    settings.background.kind = Background::transparent;
    const Scene scene = SceneBuilder()
                            .add(rectangle({0, 0, 0}, {0.7f, 0, 0}, {0, 0.7f, 0}), pane)
                            .environment(glm::vec3(1.0f))
                            .camera(lookAtOrthographic({0, 0, 5}, {0, 0, 0}, 1.0f))
                            .build();
    Rendering rendering = renderScene(device(), scene, settings).rendering;
    denoise(rendering, *denoiser_, DenoiseQuality::high, 0, true);
    const auto deviation = [&](const char* layer) {
        double sum = 0.0;
        for (uint32_t y = 16; y < 48; ++y)
            for (uint32_t x = 16; x < 48; ++x)
                sum += std::pow(rendering.find(layer)->mean.at(x, y).x - 0.25, 2.0);
        return std::sqrt(sum / (32.0 * 32.0));
    };
    EXPECT_NEAR(deviation("coverage"), std::sqrt(0.25 * 0.75 / 16.0), 0.02);
    EXPECT_LT(deviation(kDenoisedCoverage), 0.02);
    EXPECT_EQ(rendering.find(kDenoisedCoverage)->mean.at(2, 2).x, 0.0f);
}

// Errors of what is seen through the shadow, and of alpha, against 1024 samples.
TEST_F(Denoise, CleansShadowsOnTheGround) {
    Scene scene = SceneBuilder()
                      .add(ball({0, 1, 0}, 1.0f), lambert({0.8f, 0.4f, 0.3f}))
                      .environment({0.6f, 0.7f, 1.0f})
                      .camera(lookAt({0.5f, 3, 6}, {0, 0.5f, 0}, 0.7f))
                      .build();
    for (const Background background : {Background::transparent, Background::environment}) {
        RenderSettings settings = imageSettings(96, 96, 16);
        settings.layers = kDenoisingLayers;
        settings.background.kind = background;
        settings.ground.kind = Ground::shadow;
        const auto render = [&](uint32_t samples) {
            settings.stop.samples = samples;
            return renderScene(device(), scene, settings).rendering;
        };
        const Rendering reference = render(1024);
        Rendering rendering = render(16);
        denoise(rendering, *denoiser_, DenoiseQuality::high, 0, true);
        const auto error = [&](const char* layer, const char* of) {
            double sum = 0.0;
            for (size_t i = 0; i < reference.radiance().pixels.size(); ++i) {
                const float ground = reference.find("shadow")->mean.pixels[i].x;
                if (ground == 1.0f)
                    sum += std::pow(
                        rendering.find(layer)->mean.pixels[i].x - reference.find(of)->mean.pixels[i].x, 2.0);
            }
            return sum;
        };
        if (background == Background::transparent) {
            EXPECT_LT(error(kDenoisedCoverage, "coverage"), 0.3 * error("coverage", "coverage"));
            EXPECT_LE(rendering.find(kDenoisedShadow)->mean.at(48, 48).x,
                      rendering.find(kDenoisedCoverage)->mean.at(48, 48).x);
        } else {
            EXPECT_LT(error(kDenoisedLayer, "color"), 0.3 * error("color", "color"));
            EXPECT_EQ(rendering.find(kDenoisedShadow), nullptr);
        }
    }
}

TEST_F(Denoise, GivesEqualBitsEachTime) {
    const Image size(96, 64);
    const Scene scene = loadScene("cornell-glass");
    const Rendering once = denoised(scene, size, DenoiseQuality::high);
    EXPECT_EQ(once.find(kDenoisedLayer)->mean.pixels,
              denoised(scene, size, DenoiseQuality::high).find(kDenoisedLayer)->mean.pixels);
}

TEST(DenoiserLibrary, WhatIsNamedAndIsNoneIsRefusedByName) {
    const TemporaryFolder folder;
    const EnvironmentVariable named("LAVALIGHT_OIDN", folder.path().string());
    try {
        const Denoiser none;
        FAIL() << "loaded";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("libOpenImageDenoise.so.2"), std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace lavalight::test
