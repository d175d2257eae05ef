// Whole images against those of other renderers.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "compare/statistics.h"
#include "compare/welch.h"
#include "image/exr.h"
#include "session/builtin.h"
#include "support/render_scene.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

class Reference : public DeviceTest {};

// The file's pixels with their variance, as tests/references/README.md describes them.
Rendering readReference(const std::string& name) {
    const ExrFile file = readExr(std::filesystem::path(LAVALIGHT_SOURCE_DIR) / "tests/references" / name);
    return {file.radiance(), file.variance(), file.sampleCounts};
}

TEST_F(Reference, CornellBoxAtTwiceTheSizeIsTheOneOfMitsuba) {
    const Rendering reference = readReference("cornell-box.exr");
    const RenderResult result = renderScene(device(), loadScene("cornell-box"), imageSettings(256, 256, 64));
    EXPECT_EQ(countNonFinite(result.rendering.radiance()), 0u);
    EXPECT_EQ(result.tallies.droppedSamples, 0u);
    const MeanDifference difference =
        relativeMeanDifference(downsample(result.rendering, 2).radiance(), reference.radiance());
    for (glm::length_t c = 0; c < 3; ++c)
        EXPECT_LT(std::abs(difference.perChannel[c]), 0.005) << "channel " << c;
}

// A stored image, the samples that ours is given, and the pixels of a tile's side.
struct Stored {
    const char* scene;
    uint32_t samples;
    uint32_t tile;
};

std::ostream& operator<<(std::ostream& out, const Stored& stored) {
    return out << stored.scene;
}

class StoredReference : public Reference, public testing::WithParamInterface<Stored> {};

TEST_P(StoredReference, IsWhatWeRender) {
    const Stored& stored = GetParam();
    const Rendering reference = readReference(std::string(stored.scene) + ".exr");
    const RenderResult result =
        renderScene(device(), loadScene(stored.scene),
                    imageSettings(reference.radiance().width, reference.radiance().height, stored.samples));
    const Rendering& ours = result.rendering;
    EXPECT_EQ(countNonFinite(ours.radiance()), 0u);
    EXPECT_EQ(result.tallies.droppedSamples, 0u);
    const double difference = relativeMeanDifference(ours.radiance(), reference.radiance()).overall;
    const WelchTest z = welchTest({&ours.radiance(), &ours.variance()},
                                  {&reference.radiance(), &reference.variance()}, stored.tile);
    std::cout << "mean " << 100.0 * difference << " % apart; " << 100.0 * z.fractionBelow(3.3f)
              << " % of the tiles below 3.3, largest |z| " << z.maxAbsZ << "\n";
    EXPECT_LT(std::abs(difference), 0.005);
    EXPECT_GT(z.fractionBelow(3.3f), 0.99);
    expectSameMean(ours, reference, 16);
    if (HasFailure())
        ADD_FAILURE() << "difference times 10: "
                      << writeDifference(ours.radiance(), reference.radiance(), 10.0f, stored.scene);
}

// Light through the glass ball comes as rare bright samples: with as few as these the sums of smaller tiles
// are far from normal (at 256 samples 12 % of 4 x 4 tiles are beyond 3.3).
INSTANTIATE_TEST_SUITE_P(Mitsuba, StoredReference,
                         testing::Values(Stored{"cornell-box", 128, 4}, Stored{"cornell-glass", 192, 16},
                                         Stored{"veach-mis", 1024, 4}, Stored{"many-lights", 128, 4}),
                         [](const auto& stored) {
                             std::string name = stored.param.scene;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

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
    const Image file = readExr(folder_ / "CornellBox-Bitterli/reference.exr").radiance();
    ASSERT_EQ(file.width % size, 0u);
    ASSERT_EQ(file.width, file.height);
    const Rendering full{file, Image(file.width, file.height), std::vector<uint32_t>(file.pixels.size())};
    const Image reference = downsample(full, file.width / size).radiance();
    const RenderResult result =
        renderScene(device(), load("CornellBox-Bitterli"), imageSettings(size, size, 64));
    EXPECT_EQ(result.tallies.droppedSamples, 0u);
    const Image& ours = result.rendering.radiance();
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
        EXPECT_EQ(countNonFinite(result.rendering.radiance()), 0u);
        EXPECT_GT(meanOf(result.rendering).mean.g, 0.0);
    }
}

} // namespace
} // namespace lavalight::test
