// Whole images against those of other renderers.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "image/exr.h"
#include "scene/builtin.h"
#include "support/render_scene.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

class Reference : public DeviceTest {};

// The file's pixels with their variance, as tests/references/README.md describes them.
Rendering readReference(const std::string& name) {
    const ExrFile file = readExr(std::filesystem::path(LAVALIGHT_SOURCE_DIR) / "tests/references" / name);
    return {file.radiance, file.variance.value(), file.sampleCounts.value()};
}

// Tiles of 8 x 8 reference pixels. Of 768 normal numbers one in 150 sets has a |z| beyond kSigmas, and 0.1 %
// are beyond 3.3. Smaller tiles would not do: of few samples with rare bright ones, mean and variance are
// correlated.
constexpr uint32_t kTile = 8;

TEST_F(Reference, CornellBoxIsTheOneOfMitsuba) {
    const Rendering reference = readReference("cornell-box.exr");
    const RenderResult result = renderScene(device(), loadScene("cornell-box"), imageSettings(256, 256, 64));
    EXPECT_EQ(countNonFinite(result.rendering.radiance), 0u);
    EXPECT_EQ(result.tallies.droppedSamples, 0u);
    const Rendering ours = downsample(result.rendering, 2);
    const MeanDifference difference = relativeMeanDifference(ours.radiance, reference.radiance);
    EXPECT_LT(std::abs(difference.overall), 0.005);
    for (glm::length_t c = 0; c < 3; ++c)
        EXPECT_LT(std::abs(difference.perChannel[c]), 0.005) << "channel " << c;
    const ZTest z = tileZTest(ours.radiance, ours.variance, reference.radiance, reference.variance, kTile);
    EXPECT_LT(z.maxAbsZ, kSigmas) << "worst tile at " << z.worstTile.x << ", " << z.worstTile.y;
    EXPECT_GT(z.fractionBelow(3.3f), 0.99);
    expectSameMean(ours, reference, kTile);
    if (HasFailure())
        ADD_FAILURE() << "difference times 10: "
                      << writeDifference(ours.radiance, reference.radiance, 10.0f, "cornell-box");
}

// Refraction, total internal reflection, caustics and a rough metal. Light through the glass ball comes as rare bright
// samples, so tiles of 16 pixels.
TEST_F(Reference, GlassAndMetalBallsAreThoseOfMitsuba) {
    const Rendering reference = readReference("cornell-glass.exr");
    const RenderResult result =
        renderScene(device(), loadScene("cornell-glass"), imageSettings(128, 128, 192));
    EXPECT_EQ(countNonFinite(result.rendering.radiance), 0u);
    EXPECT_EQ(result.tallies.droppedSamples, 0u);
    const Rendering& ours = result.rendering;
    EXPECT_LT(std::abs(relativeMeanDifference(ours.radiance, reference.radiance).overall), 0.005);
    expectSameMean(ours, reference, 2 * kTile);
    if (HasFailure())
        ADD_FAILURE() << "difference times 10: "
                      << writeDifference(ours.radiance, reference.radiance, 10.0f, "cornell-glass");
}

class Assets : public DeviceTest {
  protected:
    void SetUp() override {
        DeviceTest::SetUp();
        const char* folder = std::getenv("LAVALIGHT_ASSETS");
        if (folder == nullptr)
            GTEST_SKIP() << "LAVALIGHT_ASSETS is not set: the folder with glTF sample scenes";
        folder_ = folder;
    }

    // The scene folder's .gltf or .glb of the same name, wherever it lies.
    [[nodiscard]] Scene load(const std::string& name) const {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / name)) {
            const auto extension = entry.path().extension();
            if (entry.path().stem() == name && (extension == ".gltf" || extension == ".glb"))
                return loadScene(entry.path().string());
        }
        throw std::runtime_error("no glTF file in " + (folder_ / name).string());
    }

    std::filesystem::path folder_;
};

TEST_F(Assets, BitterlisCornellBoxIsTheOneOfTungsten) {
    constexpr uint32_t size = 128;
    const Image file = readExr(folder_ / "CornellBox-Bitterli/reference.exr").radiance;
    ASSERT_EQ(file.width % size, 0u);
    ASSERT_EQ(file.width, file.height);
    const Rendering full{file, Image(file.width, file.height), std::vector<uint32_t>(file.pixels.size())};
    const Image reference = downsample(full, file.width / size).radiance;
    const RenderResult result =
        renderScene(device(), load("CornellBox-Bitterli"), imageSettings(size, size, 64));
    EXPECT_EQ(result.tallies.droppedSamples, 0u);
    const Image& ours = result.rendering.radiance;
    const MeanDifference difference = relativeMeanDifference(ours, reference);
    EXPECT_LT(std::abs(difference.overall), 0.01);
    for (glm::length_t c = 0; c < 3; ++c)
        EXPECT_LT(std::abs(difference.perChannel[c]), 0.01) << "channel " << c;
    if (HasFailure())
        ADD_FAILURE() << "difference times 10: "
                      << writeDifference(ours, reference, 10.0f, "bitterli-cornell-box");
}

TEST_F(Assets, RealScenesRenderWithoutNonFiniteSamples) {
    for (const char* name :
         {"FlightHelmet", "ToyCar", "LivingRoom-Bitterli", "Classroom-Bitterli", "NegativeScaleTest"}) {
        SCOPED_TRACE(name);
        const RenderResult result = renderScene(device(), load(name), imageSettings(48, 32, 4));
        EXPECT_EQ(result.tallies.droppedSamples, 0u);
        EXPECT_EQ(result.tallies.saturatedSums, 0u);
        EXPECT_EQ(countNonFinite(result.rendering.radiance), 0u);
        EXPECT_GT(meanOf(result.rendering).mean.g, 0.0);
    }
}

} // namespace
} // namespace lavalight::test
