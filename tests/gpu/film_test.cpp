// The accumulating kernel: means and variances of what paths brought home, and tallies of what did not count;
// and a film with a further layer, from the kernel to the file.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "compare/comparison.h"
#include "film/film_file.h"
#include "gpu/commands.h"
#include "kernels/kernel_source.h"
#include "render/film.h"
#include "render/tone_mapper.h"
#include "shared/frame.h"
#include "shared/path_layers.h"
#include "shared/wavefront.h"
#include "support/patched_kernel.h"
#include "support/random_numbers.h"
#include "support/temporary_folder.h"
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
        const gpu::Kernel kernel(device(), embeddedKernel("accumulate_layers"));
        accumulate(film, waves, kernel, 1);
    }
    // Adds `together` samples per pixel and wave: paths lie pixel by pixel.
    void accumulate(const Film& film, const std::vector<std::vector<Path>>& waves, const gpu::Kernel& kernel,
                    uint32_t together) {
        FrameParameters parameters{};
        parameters.imageWidth = kWidth;
        parameters.imageHeight = kHeight;
        parameters.bandPixels = kPixels;
        parameters.waveSize = kPixels;
        gpu::Buffer frame(device(), "frame", sizeof parameters, gpu::BufferUse::uniform);
        frame.upload(std::span<const FrameParameters>(&parameters, 1));
        gpu::Buffer paths(device(), "paths", together * kPixels * sizeof(Path), gpu::BufferUse::storage);
        gpu::ResourceTable resources;
        resources.set("Frame", frame);
        resources.set("Paths", paths);
        const gpu::Buffer unused(device(), "layers", sizeof(PathLayers), gpu::BufferUse::storage);
        for (const char* name : {"Layers", "Triangles", "Surfaces"}) // that none reads
            resources.set(name, unused);
        resources.set("Film", film.bands().front().sums);
        resources.set("Tallies", film.tallies());
        const gpu::BoundKernel bound(device(), kernel, resources);
        WaveRange range{};
        range.pixelCount = kPixels;
        range.sampleCount = together;
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
            ASSERT_NEAR(rendering.radiance().pixels[pixel][channel], mean, 1e-6 * mean);
            ASSERT_NEAR(rendering.variance().pixels[pixel][channel], variance, 1e-5 * variance);
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
        EXPECT_EQ(rendering.radiance().pixels[pixel].y, pixel < 3 ? 3.0f : 2.0f);
    }
    EXPECT_EQ(film.readTallies().droppedSamples, 3u);
    EXPECT_EQ(film.readTallies().saturatedSums, 0u);
}

TEST_F(FilmTest, SumsBeyondTheRangeSaturateAndAreCounted) {
    const Film film(device(), kWidth, kHeight, 0);
    std::vector<Path> paths = wave(glm::vec3(1.0f));
    paths[7].radiance.x = 1e20f; // the sum and the sum of squares
    paths[9].radiance.y = 1e12f; // the sum of squares alone
    accumulate(film, {paths});
    EXPECT_EQ(film.readTallies().saturatedSums, 3u);
    EXPECT_GT(film.resolve().radiance().pixels[7].x, 1e14f);
}

TEST_F(FilmTest, NegativeRadianceIsCountedAndTakenForZero) {
    const Film film(device(), kWidth, kHeight, 0);
    std::vector<Path> paths = wave(glm::vec3(1.0f));
    paths[7].radiance = {-0.5f, 2.0f, -1e-30f}; // one sample, however many of its channels
    paths[9].radiance.y = -1e12f;
    paths[11].radiance.z = -0.0f;
    paths[13].radiance.x = -std::numeric_limits<float>::infinity(); // dropped, not taken for 0
    accumulate(film, {paths});
    const FilmTallies tallies = film.readTallies();
    EXPECT_EQ(tallies.negativeSamples, 2u);
    EXPECT_EQ(tallies.droppedSamples, 1u);
    EXPECT_EQ(tallies.saturatedSums, 0u);
    const Rendering rendering = film.resolve();
    EXPECT_EQ(rendering.radiance().pixels[7], glm::vec3(0.0f, 2.0f, 0.0f));
    EXPECT_EQ(rendering.radiance().pixels[9], glm::vec3(1.0f, 0.0f, 1.0f));
    EXPECT_EQ(rendering.sampleCounts[7], 1u);
    EXPECT_EQ(rendering.sampleCounts[13], 0u);
}

// A layer that no render has, with sign: its row among the planes, and the line that fills it. All else is
// what the film does for any layer.
class SignedLayerTest : public FilmTest {
  protected:
    static constexpr uint32_t kLean = kFilmPlaneCount; // the row
    static constexpr float kBroken = 7.0f;             // a red that makes the layer NaN, and the colour not
    // x - y and -z of the radiance.
    [[nodiscard]] static gpu::KernelCode leaningKernel(bool hasSquares) {
        const std::string row = R"("behind.R,behind.G,behind.B", 3u, kWeighted, 0u, 0u))";
        const std::string added = fmt::format(R"( PLANE({}u, "lean", "lean.X,lean.Y", 2u, 1u, {}u, 0u))",
                                              kLean, hasSquares ? 1 : 0);
        const std::string fill = "    return paths[slot].radiance;";
        const std::string line =
            fmt::format("    if (plane == {0}u && paths[slot].radiance.x == {1:.1f}) return "
                        "vec3(uintBitsToFloat(0x7fc00000u));\n"
                        "    if (plane == {0}u) return vec3(paths[slot].radiance.x - paths[slot].radiance.y, "
                        "-paths[slot].radiance.z, 0.0);\n",
                        kLean, kBroken);
        return patchedKernel("accumulate_layers", {{"shared/film.h", row, row + added},
                                                   {"scene/film_sink.glsl", fill, line + fill}});
    }
    [[nodiscard]] static FilmLayout layout(bool hasSquares) {
        std::vector<LayerPlane> planes(colorLayout().planes().begin(), colorLayout().planes().end());
        planes.push_back({"lean", {"lean.X", "lean.Y"}, {2, 1, hasSquares ? 1u : 0u, 0}});
        return FilmLayout(std::move(planes));
    }
    [[nodiscard]] gpu::Kernel kernel(bool hasSquares, uint32_t asked = 1u << kColorPlane | 1u << kLean) {
        const std::array<gpu::SpecialisationConstant, 1> constants{{{CONSTANT_FILM_PLANES, asked}}};
        return gpu::Kernel(device(), leaningKernel(hasSquares), constants);
    }
    // `count` waves of one sample a pixel, of random radiance.
    [[nodiscard]] static std::vector<std::vector<Path>> someWaves(size_t count) {
        Random random(5);
        std::vector<std::vector<Path>> waves(count, wave(glm::vec3(0.0f)));
        for (std::vector<Path>& paths : waves)
            for (Path& path : paths)
                path.radiance = {random.unit(), 3.0f * random.unit(), 1e3f * random.unit()};
        return waves;
    }
    [[nodiscard]] RawFilm filmOf(const std::vector<std::vector<Path>>& waves) {
        const Film film(device(), kWidth, kHeight, 0, layout(true));
        accumulate(film, waves, kernel(true), 1);
        return film.read();
    }
};

TEST_F(SignedLayerTest, SamplesThatAreNaNInALayerAreInNoPlane) {
    std::vector<std::vector<Path>> waves{wave({1.0f, 2.0f, 3.0f}), wave({1.0f, 2.0f, 3.0f})};
    waves[1][4].radiance.x = kBroken;
    const Film film(device(), kWidth, kHeight, 0, layout(true));
    accumulate(film, waves, kernel(true), 1);
    EXPECT_EQ(film.readTallies().droppedSamples, 1u);
    const Rendering rendering = film.resolve();
    EXPECT_EQ(rendering.sampleCounts[3], 2u);
    EXPECT_EQ(rendering.sampleCounts[4], 1u);
    for (const size_t pixel : {3, 4}) {
        EXPECT_EQ(rendering.radiance().pixels[pixel], glm::vec3(1.0f, 2.0f, 3.0f));
        EXPECT_EQ(rendering.find("lean")->mean.pixels[pixel], glm::vec3(-1.0f, -3.0f, 0.0f));
    }
}

TEST_F(SignedLayerTest, HoldsMeansAndVariancesOfValuesOnBothSidesOfZero) {
    for (const bool hasSquares : {true, false}) {
        const Film film(device(), kWidth, kHeight, 0, layout(hasSquares));
        const std::vector<std::vector<Path>> waves = someWaves(20);
        accumulate(film, waves, kernel(hasSquares), 1);
        const Rendering rendering = film.resolve();
        const Layer& lean = *rendering.find("lean");
        ASSERT_EQ(lean.variance.has_value(), hasSquares);
        size_t negative = 0;
        for (size_t pixel = 0; pixel < kPixels; ++pixel) {
            glm::dvec2 sum(0.0);
            glm::dvec2 squares(0.0);
            for (const std::vector<Path>& paths : waves) {
                const glm::vec3& l = paths[pixel].radiance;
                const glm::dvec2 x(l.x - l.y, -l.z); // rounded as the kernel does
                sum += x;
                squares += x * x;
            }
            const double n = 20.0;
            for (glm::length_t c = 0; c < 2; ++c) {
                const double mean = sum[c] / n;
                ASSERT_NEAR(lean.mean.pixels[pixel][c], mean, 1e-6 * std::abs(mean) + 1e-12);
                const double variance = (squares[c] / n - mean * mean) / (n - 1.0);
                if (hasSquares) {
                    ASSERT_NEAR(lean.variance->pixels[pixel][c], variance, 1e-5 * variance);
                }
                negative += mean < 0.0 ? 1 : 0;
            }
            ASSERT_EQ(lean.mean.pixels[pixel].z, 0.0f);
        }
        EXPECT_GT(negative, kPixels); // all of one component, and most of the other
        EXPECT_EQ(film.readTallies().negativeSamples, 0u);
        EXPECT_EQ(film.readTallies().limitedValues, 0u);
    }
}

TEST_F(SignedLayerTest, LeavesTheBitsOfRadianceAsTheyAre) {
    const std::vector<std::vector<Path>> waves = someWaves(5);
    const Film alone(device(), kWidth, kHeight, 0);
    accumulate(alone, waves);
    const RawFilm expected = alone.read();
    const RawFilm raw = filmOf(waves);
    const size_t color = size_t{colorLayout().countWord()} * kPixels;
    EXPECT_TRUE(std::equal(expected.words.begin(), expected.words.begin() + color, raw.words.begin()));
    EXPECT_TRUE(std::equal(expected.words.end() - kPixels, expected.words.end(), raw.words.end() - kPixels));
    // Compiled in, but not asked for.
    const Film unasked(device(), kWidth, kHeight, 0);
    accumulate(unasked, waves, kernel(true, 1u << kColorPlane), 1);
    EXPECT_EQ(unasked.read().words, expected.words);
}

TEST_F(SignedLayerTest, HasTheSameBitsInAnyOrderWaveBandOrMerge) {
    const std::vector<std::vector<Path>> waves = someWaves(6);
    const RawFilm whole = filmOf(waves);
    EXPECT_EQ(filmOf({waves.rbegin(), waves.rend()}).words, whole.words);
    RawFilm sum = filmOf({waves.begin(), waves.begin() + 2});
    add(sum, filmOf({waves.begin() + 2, waves.end()}));
    EXPECT_EQ(sum.words, whole.words);
    std::vector<Path> together; // all samples of a pixel in one wave
    for (size_t pixel = 0; pixel < kPixels; ++pixel)
        for (const std::vector<Path>& paths : waves)
            together.push_back(paths[pixel]);
    const Film film(device(), kWidth, kHeight, 0, layout(true));
    accumulate(film, {together}, kernel(true), 6);
    EXPECT_EQ(film.read().words, whole.words);
    Film banded(device(), kWidth, kHeight, 2, layout(true));
    ASSERT_EQ(banded.bands().size(), 3u);
    banded.restore(whole);
    EXPECT_EQ(banded.read().words, whole.words);
    EXPECT_EQ(banded.resolve().find("lean")->mean.pixels, resolve(whole).find("lean")->mean.pixels);
}

TEST_F(SignedLayerTest, LimitsValuesAtBothEndsAndCountsThem) {
    const Film film(device(), kWidth, kHeight, 0, layout(false));
    std::vector<Path> paths = wave(glm::vec3(1.0f));
    paths[3].radiance = {1e20f, 0.0f,
                         1e20f}; // beyond both ends; saturates two sums and two squares of radiance
    std::vector<Path> back = wave(glm::vec3(1.0f));
    back[3].radiance = {0.0f, 1e20f, 0.0f}; // and back to 0
    accumulate(film, {paths, back}, kernel(false), 1);
    const Rendering rendering = film.resolve();
    EXPECT_EQ(rendering.find("lean")->mean.pixels[3], glm::vec3(0.0f, -0.5f * kMostSigned, 0.0f));
    EXPECT_EQ(film.readTallies().limitedValues, 3u);
    EXPECT_EQ(film.readTallies().saturatedSums, 6u);
}

TEST_F(SignedLayerTest, DropsASampleThatIsNoNumberThereFromEveryPlane) {
    const Film film(device(), kWidth, kHeight, 0, layout(false));
    std::vector<Path> paths = wave(glm::vec3(1.0f, 0.5f, 0.25f));
    paths[5].radiance = {std::numeric_limits<float>::max(), -std::numeric_limits<float>::max(), 1.0f};
    accumulate(film, {wave(glm::vec3(3.0f)), paths}, kernel(false), 1); // x - y is infinite, x and y are not
    const Rendering rendering = film.resolve();
    EXPECT_EQ(rendering.sampleCounts[5], 1u);
    EXPECT_EQ(rendering.radiance().pixels[5], glm::vec3(3.0f));
    EXPECT_EQ(rendering.find("lean")->mean.pixels[5], glm::vec3(0.0f, -3.0f, 0.0f));
    EXPECT_EQ(film.readTallies().droppedSamples, 1u);
}

TEST_F(SignedLayerTest, IsShownByTheToneMapper) {
    const RawFilm raw = filmOf({wave({0.5f, 0.25f, 0.5f})}); // lean: 0.25, -0.5
    Film film(device(), kWidth, kHeight, 2, layout(true));
    film.restore(raw);
    ToneMapper mapper(device());
    const std::vector<uint32_t> shown = mapper.map(film, {ToneCurve::linear, 1.0f}, 1);
    const std::vector<uint32_t> color = mapper.map(film, {ToneCurve::linear, 1.0f});
    EXPECT_EQ(shown, std::vector<uint32_t>(kPixels, 0xff0000bcu)); // sRGB of 0.5 is 188; below 0 it is black
    EXPECT_EQ(color, std::vector<uint32_t>(kPixels, 0xffffbcffu));
}

TEST_F(SignedLayerTest, ComesBackFromAFileAndMayBeComparedThere) {
    const TemporaryFolder folder;
    const RawFilm raw = filmOf(someWaves(8));
    const FilmFile file{raw, {{0, 8}}, {8, 0, 0}, {}};
    writeFilmFile(folder / "a.exr", file);
    const RawFilm back = readFilmFile(folder / "a.exr").film;
    EXPECT_EQ(back.words, raw.words);
    EXPECT_EQ(back.layout, raw.layout);
    const ComparedImage image = readCompared(folder / "a.exr");
    ComparedImage other = image;
    EXPECT_TRUE(compare(image, image, {}).isEqual());
    for (glm::vec3& pixel : other.content.layers[1].mean.pixels)
        pixel.y += 500.0f;
    const Comparison comparison = compare(other, image, {});
    EXPECT_FALSE(comparison.isEqual());
    ASSERT_EQ(comparison.layers.size(), 1u);
    EXPECT_NEAR(comparison.layers.front().rmse, 500.0 / std::sqrt(2.0), 0.01);
    EXPECT_FALSE(comparison.verdicts.back().passed);
    EXPECT_EQ(comparison.verdicts.back().criterion, "Z-test of lean");
    EXPECT_NE(comparison.verdicts.back().where.find("lean.Y"), std::string::npos)
        << comparison.verdicts.back().where;
    EXPECT_TRUE(comparison.verdicts.front().passed);
}

} // namespace
} // namespace lavalight::test
