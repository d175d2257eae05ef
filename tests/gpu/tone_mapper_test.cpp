// What the tone mapper makes of a film is what its curve makes of the film's means.
#include "render/tone_mapper.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/renderer.h"
#include "render/setting_names.h"
#include "session/builtin.h"
#include "support/render_scene.h"
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
    const Image mean = renderer->film().resolve().radiance;
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
    const Image mean = renderer->film().resolve().radiance;
    const std::vector<uint32_t> bright = mapper_.map(renderer->film(), {ToneCurve::linear, 1000.0f});
    for (size_t i = 0; i < bright.size(); ++i)
        for (glm::length_t c = 0; c < 3; ++c)
            ASSERT_EQ(bright[i] >> (8 * c) & 0xffu, mean.pixels[i][c] > 0.0f ? 255u : 0u) << i;
    EXPECT_EQ(mapper_.map(renderer->film(), {ToneCurve::linear, -1000.0f}),
              std::vector<uint32_t>(bright.size(), kBlack));
    EXPECT_NE(std::count(bright.begin(), bright.end(), kWhite), 0);
}

} // namespace
} // namespace lavalight::test
