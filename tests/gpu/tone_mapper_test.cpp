// What the tone mapper makes of a film is what its curve makes of the film's means.
#include "render/tone_mapper.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "film/film_shadow.h"
#include "render/renderer.h"
#include "render/setting_names.h"
#include "session/builtin.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"
#include "support/tone_reference.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kBlack = 0xff000000;
constexpr uint32_t kWhite = 0xffffffff;

class ToneMapperTest : public DeviceTest {
  protected:
    // Pixels by the thousand, in bands that do not divide them evenly.
    [[nodiscard]] std::unique_ptr<Renderer> render(uint32_t width, uint32_t height, uint32_t bandRows) {
        RenderSettings settings = imageSettings(width, height, 3); // counts that do not divide evenly either
        settings.work.bandRows = bandRows;
        auto renderer = std::make_unique<Renderer>(device(), scene_, scene_.cameras.front(), settings);
        renderer->render([](double) { return true; });
        return renderer;
    }

    ToneMapper mapper_{device()};

  private:
    const Scene scene_ = loadScene("cornell-box");
};

TEST_F(ToneMapperTest, EveryPixelIsTheFilmsMeanExposedMappedAndRounded) {
    const auto renderer = render(40, 36, 7);
    ASSERT_EQ(renderer->film().bands().size(), 6u);
    const Image mean = renderer->film().resolve().radiance();
    for (const SettingName<ToneCurve>& curve : settingNames<ToneCurve>())
        for (const float exposure : {-1.5f, 0.0f, 3.0f}) {
            const std::vector<uint32_t> pixels = mapper_.map(renderer->film(), {curve.value, exposure});
            ASSERT_EQ(pixels.size(), mean.pixels.size());
            for (size_t i = 0; i < pixels.size(); ++i) {
                const glm::dvec3 exposed = glm::dvec3(mean.pixels[i]) * std::exp2(double{exposure});
                const glm::dvec3 signal = srgbSignal(toneReference(curve.value, exposed));
                for (glm::length_t c = 0; c < 3; ++c) // rounded to nearest, give or take a driver's power
                    ASSERT_NEAR(pixels[i] >> (8 * c) & 0xffu, 255.0 * signal[c], 0.5 + 0.02)
                        << curve.name << " " << exposure << ", pixel " << i;
                ASSERT_EQ(pixels[i] >> 24, 255u);
            }
        }
}

TEST_F(ToneMapperTest, BandsAndEarlierCallsChangeNoPixel) {
    const auto whole = render(40, 36, 0);
    const ToneSettings tone{ToneCurve::agx, 1.0f};
    const std::vector<uint32_t> expected = mapper_.map(whole->film(), tone);
    for (const uint32_t bandRows : {1u, 7u, 35u}) {
        const auto cut = render(40, 36, bandRows);
        EXPECT_EQ(mapper_.map(cut->film(), tone), expected) << bandRows;
    }
    const auto larger = render(64, 50, 0);
    EXPECT_EQ(mapper_.map(larger->film(), tone), ToneMapper(device()).map(larger->film(), tone));
    EXPECT_EQ(mapper_.map(whole->film(), tone), expected);
}

TEST_F(ToneMapperTest, PixelsWithoutSamplesAreBlackWhateverTheCurveAndTheExposure) {
    const Film film(device(), 70, 5, 2);
    for (const SettingName<ToneCurve>& curve : settingNames<ToneCurve>())
        for (const float exposure : {-1000.0f, 0.0f, 1000.0f})
            EXPECT_EQ(mapper_.map(film, {curve.value, exposure}), std::vector<uint32_t>(350, kBlack))
                << curve.name << " " << exposure;
}

TEST_F(ToneMapperTest, ExposuresWithoutMeasureEndInBlackAndWhite) {
    const auto renderer = render(40, 36, 0);
    const Image mean = renderer->film().resolve().radiance();
    const std::vector<uint32_t> bright = mapper_.map(renderer->film(), {ToneCurve::linear, 1000.0f});
    for (size_t i = 0; i < bright.size(); ++i)
        for (glm::length_t c = 0; c < 3; ++c)
            ASSERT_EQ(bright[i] >> (8 * c) & 0xffu, mean.pixels[i][c] > 0.0f ? 255u : 0u) << i;
    EXPECT_EQ(mapper_.map(renderer->film(), {ToneCurve::linear, -1000.0f}),
              std::vector<uint32_t>(bright.size(), kBlack));
    EXPECT_NE(std::count(bright.begin(), bright.end(), kWhite), 0);
}

// The associated colour of a pixel that is covered by a quarter is a quarter of what shines.
TEST_F(ToneMapperTest, AlphaIsStraightAndABackdropArrivesAsGivenFromFilmAndImageAlike) {
    RenderSettings settings = imageSettings(64, 16, 16);
    settings.background.kind = Background::transparent;
    Material pane = light(glm::vec3(0.5f));
    pane.alphaMode = AlphaMode::blend;
    pane.alpha = 0.25f;
    const Scene scene = SceneBuilder()
                            .add(rectangle({-2, 0, 0}, {2, 0, 0}, {0, 9, 0}), pane)
                            .camera(lookAtOrthographic({0, 0, 5}, {0, 0, 0}, 1.0f))
                            .build();
    Renderer renderer(device(), scene, scene.cameras.front(), settings);
    renderer.render([](double) { return true; });
    const Rendering rendering = renderer.rendering();
    const Image& coverage = rendering.find(kCoverageLayer)->mean;
    const ToneSettings open{ToneCurve::linear, 1.0f}; // 0.5 shines as 1
    ToneSettings onRed = open;
    onRed.backdrop = glm::vec3(1.0f, 0.0f, 0.0f);
    const std::vector<uint32_t> pixels = mapper_.map(renderer.film(), open);
    const std::vector<uint32_t> backed = mapper_.map(renderer.film(), onRed);
    EXPECT_EQ(mapper_.map(rendering.radiance(), &coverage, open), pixels);
    EXPECT_EQ(mapper_.map(rendering.radiance(), &coverage, onRed), backed);
    size_t partly = 0;
    for (size_t i = 0; i < pixels.size(); ++i) {
        const double alpha = coverage.pixels[i].x;
        ASSERT_NEAR(pixels[i] >> 24, 255.0 * alpha, 0.51) << i;
        ASSERT_EQ(pixels[i] & 0xffffffu, alpha > 0.0 ? 0xffffffu : 0u) << i;
        ASSERT_EQ(backed[i] & 0xff0000ffu, 0xff0000ffu) << i; // opaque, and red in red and in white
        const double green = srgbSignal(glm::dvec3(alpha)).y;
        ASSERT_NEAR(backed[i] >> 8 & 0xffu, 255.0 * green, 0.52) << i;
        partly += alpha > 0.0 && alpha < 1.0 ? 1 : 0;
    }
    EXPECT_GT(partly, 200u);
}

// A pane of which a half is there, above a ground in the shadow of a lid: the pane's half is white, and what
// the lid leaves of the backdrop comes through the other.
TEST_F(ToneMapperTest, ShadowsAreBlackBesideTheCurveFromFilmAndImageAlike) {
    Material pane = light(glm::vec3(0.5f));
    pane.alphaMode = AlphaMode::blend;
    pane.alpha = 0.5f;
    Scene scene = SceneBuilder()
                      .add(rectangle({0, 2, 4}, {9, 0, 0}, {0, 2, 0}), pane)
                      .add(rectangle({-50, 90, 0}, {50, 0, 0}, {0, 0, 50}), lambert(glm::vec3(0.5f)))
                      .camera(lookAtOrthographic({0, 4, 8}, {0, 0, 0}, 1.0f))
                      .build();
    PunctualLight overhead;
    overhead.kind = PunctualKind::directional;
    overhead.direction = {0, -1, 0};
    scene.punctualLights.push_back(overhead);
    RenderSettings settings = imageSettings(64, 16, 16);
    settings.ground.kind = Ground::shadow;
    const ToneSettings tone{ToneCurve::linear, 1.0f, glm::vec3(1.0f, 0.0f, 0.0f)}; // 0.5 shines as 1
    for (const Background kind : {Background::transparent, Background::constant}) {
        settings.background = {kind, glm::vec3(0.5f, 0.0f, 0.0f)};
        Renderer renderer(device(), scene, scene.cameras.front(), settings);
        renderer.render([](double) { return true; });
        const Rendering rendering = renderer.rendering();
        const Image& shadow = rendering.find("shadow")->mean;
        Image alphas(64, 16);
        for (size_t i = 0; i < alphas.pixels.size(); ++i)
            alphas.pixels[i].x = shadowAlpha(shadow.pixels[i]);
        const Layer* coverage = rendering.find(kCoverageLayer);
        const std::vector<uint32_t> pixels = mapper_.map(renderer.film(), tone);
        EXPECT_EQ(mapper_.map(rendering.radiance(), coverage != nullptr ? &coverage->mean : nullptr, tone,
                              coverage != nullptr ? &alphas : nullptr),
                  pixels);
        size_t partly = 0;
        for (size_t i = 0; i < pixels.size(); ++i) {
            const double white = 1.0 - shadow.pixels[i].x;
            const double behind = shadow.pixels[i].x - alphas.pixels[i].x;
            const glm::dvec3 signal = srgbSignal(glm::dvec3(white + behind, white, white));
            ASSERT_NEAR(pixels[i] & 0xffu, 255.0 * signal.x, 0.52) << i;
            ASSERT_NEAR(pixels[i] >> 8 & 0xffu, 255.0 * signal.y, 0.52) << i;
            partly += alphas.pixels[i].x > 0.0f && white > 0.0 ? 1 : 0;
        }
        EXPECT_GT(partly, 200u);
        EXPECT_LT(partly, 600u); // the right half is lit
    }
}

} // namespace
} // namespace lavalight::test
