// Alpha is the share of rays that a surface stops, camera rays and shadow rays alike, and no scattering.
#include <cmath>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "support/pictures.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr glm::dvec3 kSky(1.0, 2.0, 4.0);

Material sheetOf(float alpha) {
    Material sheet = lambert(glm::vec3(0.0f));
    sheet.alphaMode = AlphaMode::blend;
    sheet.alpha = alpha;
    return sheet;
}

// Black sheets one behind the other, before a sky.
Scene sheets(int count, float alpha) {
    SceneBuilder builder;
    for (int i = 0; i < count; ++i)
        builder.add(rectangle({0, 0, -0.1f * static_cast<float>(i)}, {4, 0, 0}, {0, 4, 0}), sheetOf(alpha));
    return builder.environment(glm::vec3(kSky)).camera(lookAt({0.5f, 0.5f, 2}, {0, 0, 0}, 0.4f)).build();
}

class Alpha : public DeviceTest {};

TEST_F(Alpha, ThreeSheetsTransmitTheProduct) {
    expectMean(renderScene(device(), sheets(3, 0.3f), imageSettings(32, 32, 256)), kSky * std::pow(0.7, 3),
               0.005);
}

TEST_F(Alpha, TenSheetsTransmitTheProductAndAreNoBounces) {
    RenderSettings settings = imageSettings(64, 64, 1024);
    settings.estimator.maxBounces = 0;
    expectMean(renderScene(device(), sheets(10, 0.5f), settings), kSky * std::pow(0.5, 10), 0.02);
}

TEST_F(Alpha, TheWavefrontHasTheBitsOfTheFusedKernel) {
    RenderSettings settings = imageSettings(16, 16, 16);
    settings.work.schedule = Schedule::fused;
    const RenderResult fused = renderScene(device(), sheets(3, 0.5f), settings);
    settings.work.schedule = Schedule::wavefront;
    EXPECT_EQ(renderScene(device(), sheets(3, 0.5f), settings).filmWords, fused.filmWords);
}

// Rows of texels: alpha 64, 128, 192, 255, over a white sky; the sheet itself is black.
Scene textured(AlphaMode mode, float cutoff) {
    Material sheet = lambert(glm::vec3(0.0f));
    sheet.alphaMode = mode;
    sheet.alphaCutoff = cutoff;
    Scene scene = SceneBuilder()
                      .add(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), sheet)
                      .environment(glm::vec3(1.0f))
                      .camera(lookAtOrthographic({0, 0, 2}, {0, 0, 0}, 1.0f))
                      .build();
    scene.pictures = {pictureOf(1, 4, {{0, 0, 0, 64}, {0, 0, 0, 128}, {0, 0, 0, 192}, {0, 0, 0, 255}})};
    putOnRectangle(scene, 0, TextureSlot::baseColor, textureOf(0));
    return scene;
}

TEST_F(Alpha, TheTexturesAlphaCounts) {
    const double passed = 1.0 - (64 + 128 + 192 + 255) / (4.0 * 255.0);
    expectMean(renderScene(device(), textured(AlphaMode::blend, 0.5f), imageSettings(16, 16, 1024)),
               glm::dvec3(passed), 0.01);
}

// v is 0 at the bottom of the rectangle, and so is the first row of texels.
TEST_F(Alpha, AMaskPassesAllBelowItsCutoffAndNothingElse) {
    const RenderResult result =
        renderScene(device(), textured(AlphaMode::mask, 128.0f / 255.0f), imageSettings(16, 16, 16));
    for (uint32_t y = 0; y < 16; ++y)
        EXPECT_EQ(result.rendering.radiance.pixels[y * 16 + 8].g, y >= 12 ? 1.0f : 0.0f) << y;
}

TEST_F(Alpha, TheColoursOfVerticesHaveAlphaToo) {
    Material sheet = lambert(glm::vec3(0.0f));
    sheet.alphaMode = AlphaMode::blend;
    Scene scene = sheets(1, 1.0f);
    scene.meshes[0].colors.assign(4, glm::vec4(1.0f, 1.0f, 1.0f, 0.25f));
    expectMean(renderScene(device(), scene, imageSettings(16, 16, 1024)), kSky * 0.75, 0.005);
}

struct Strategy {
    const char* name;
    bool nee;
};

std::ostream& operator<<(std::ostream& out, const Strategy& strategy) {
    return out << strategy.name;
}

class AlphaLight : public DeviceTest, public testing::WithParamInterface<Strategy> {
  protected:
    [[nodiscard]] RenderResult renderWith(const Scene& scene) {
        RenderSettings settings = imageSettings(16, 16, 1024);
        settings.estimator.nextEventEstimation = GetParam().nee;
        settings.estimator.maxBounces = 1;
        return renderScene(device(), scene, settings);
    }
    // A white floor between two walls of light, seen from above through a small window in nothing.
    static SceneBuilder floorUnder(const Material& lamp) {
        SceneBuilder builder;
        builder.add(rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), lambert(glm::vec3(1.0f)));
        builder.add(rectangle({0, 1000, 0}, {100000, 0, 0}, {0, 0, 100000}), lamp);
        builder.camera(lookAtOrthographic({0.2f, 0.1f, 0.05f}, {0, 0, 0}, 1e-3f));
        return builder;
    }
};

// Lamp and sheets are as good as infinite: the floor sees nothing else.
TEST_P(AlphaLight, ShadowsOfSheetsAreTheProductOfWhatPasses) {
    SceneBuilder builder = floorUnder(light(glm::vec3(kSky)));
    for (int i = 0; i < 2; ++i)
        builder.add(rectangle({0, 100.0f + static_cast<float>(i), 0}, {100000, 0, 0}, {0, 0, 100000}),
                    sheetOf(0.4f));
    expectMean(renderWith(builder.build()), kSky * 0.36, 0.01);
}

TEST_P(AlphaLight, ALampThatIsHalfThereGivesHalf) {
    Material lamp = light(glm::vec3(kSky));
    lamp.alphaMode = AlphaMode::blend;
    lamp.alpha = 0.5f;
    expectMean(renderWith(floorUnder(lamp).build()), kSky * 0.5, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Strategies, AlphaLight,
                         testing::Values(Strategy{"lightAndBsdfSamples", true},
                                         Strategy{"bsdfSamplesOnly", false}),
                         [](const auto& strategy) { return std::string(strategy.param.name); });

} // namespace
} // namespace lavalight::test
