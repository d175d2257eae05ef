// The accumulating kernel: means and variances of what paths brought home, and tallies of what did not count.
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/commands.h"
#include "kernels/kernel_source.h"
#include "render/film.h"
#include "shared/frame.h"
#include "shared/wavefront.h"
#include "support/random_numbers.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kWidth = 40;
constexpr uint32_t kHeight = 5;
constexpr uint32_t kPixels = kWidth * kHeight;

class FilmTest : public DeviceTest {
  protected:
    // Adds one sample per pixel and wave.
    void accumulate(const Film& film, const std::vector<std::vector<Path>>& waves) {
        FrameParameters parameters{};
        parameters.imageWidth = kWidth;
        parameters.imageHeight = kHeight;
        parameters.bandPixels = kPixels;
        parameters.waveSize = kPixels;
        gpu::Buffer frame(device(), "frame", sizeof parameters, gpu::BufferUse::uniform);
        frame.upload(std::span<const FrameParameters>(&parameters, 1));
        gpu::Buffer paths(device(), "paths", kPixels * sizeof(Path), gpu::BufferUse::storage);
        gpu::ResourceTable resources;
        resources.set("Frame", frame);
        resources.set("Paths", paths);
        resources.set("Film", film.bands().front().sums);
        resources.set("Tallies", film.tallies());
        const gpu::Kernel kernel(device(), embeddedKernel("accumulate"));
        const gpu::BoundKernel bound(device(), kernel, resources);
        const WaveRange range{0, kPixels, 0, 1, 0, 0, 0, 0, 0};
        gpu::Commands commands(device());
        for (const std::vector<Path>& wave : waves) {
            paths.upload(std::span<const Path>(wave));
            commands.begin();
            commands.dispatch(bound, (kPixels + 63) / 64, std::as_bytes(std::span(&range, 1)));
            commands.submitAndWait();
        }
    }
    static std::vector<Path> wave(const glm::vec3& radiance) {
        return std::vector<Path>(kPixels, {glm::vec3(1.0f), 0.0f, radiance, 1.0f});
    }
};

TEST_F(FilmTest, MeanAndVarianceAreThoseOfTheSamples) {
    const Film film(device(), kWidth, kHeight, 0);
    Random random(1);
    std::vector<std::vector<Path>> waves(20, wave(glm::vec3(0.0f)));
    for (std::vector<Path>& paths : waves)
        for (Path& path : paths)
            path.radiance = {random.unit(), 1e-6f * random.unit(), 1e6f * random.unit()};
    accumulate(film, waves);
    const Rendering rendering = film.resolve();
    for (size_t pixel = 0; pixel < kPixels; ++pixel) {
        ASSERT_EQ(rendering.sampleCounts[pixel], waves.size());
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            double sum = 0.0;
            double squares = 0.0;
            for (const std::vector<Path>& paths : waves) {
                const double x = paths[pixel].radiance[channel];
                sum += x;
                squares += x * x;
            }
            const double n = static_cast<double>(waves.size());
            const double mean = sum / n;
            const double variance = (squares / n - mean * mean) / (n - 1.0);
            ASSERT_NEAR(rendering.radiance.pixels[pixel][channel], mean, 1e-6 * mean);
            ASSERT_NEAR(rendering.variance.pixels[pixel][channel], variance, 1e-5 * variance);
        }
    }
}

TEST_F(FilmTest, SamplesThatAreNoNumbersAreDroppedAndCounted) {
    const Film film(device(), kWidth, kHeight, 0);
    std::vector<Path> broken = wave(glm::vec3(1.0f));
    broken[0].radiance.x = std::numeric_limits<float>::quiet_NaN();
    broken[1].radiance.y = std::numeric_limits<float>::infinity();
    broken[2].radiance.z = -std::numeric_limits<float>::infinity();
    accumulate(film, {wave(glm::vec3(3.0f)), broken});
    const Rendering rendering = film.resolve();
    for (size_t pixel = 0; pixel < kPixels; ++pixel) {
        EXPECT_EQ(rendering.sampleCounts[pixel], pixel < 3 ? 1u : 2u);
        EXPECT_EQ(rendering.radiance.pixels[pixel].y, pixel < 3 ? 3.0f : 2.0f);
    }
    EXPECT_EQ(film.readTallies().droppedSamples, 3u);
    EXPECT_EQ(film.readTallies().saturatedSums, 0u);
}

TEST_F(FilmTest, SumsBeyondTheRangeSaturateAndAreCounted) {
    const Film film(device(), kWidth, kHeight, 0);
    std::vector<Path> paths = wave(glm::vec3(1.0f));
    paths[7].radiance.x = 1e20f; // the sum and the sum of squares
    paths[9].radiance.y = 1e12f; // its square alone
    accumulate(film, {paths});
    EXPECT_EQ(film.readTallies().saturatedSums, 3u);
    EXPECT_GT(film.resolve().radiance.pixels[7].x, 1e14f);
}

} // namespace
} // namespace lavalight::test
