#include "support/render_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "compare/statistics.h"
#include "compare/welch.h"
#include "image/png.h"
#include "render/renderer.h"

namespace lavalight::test {
namespace {

std::vector<uint32_t> wordsOf(const Film& film) {
    const size_t each = film.layout().words();
    std::vector<uint32_t> words;
    for (const FilmBand& band : film.bands()) {
        const auto planes = band.sums.downloadAll<uint32_t>();
        const size_t pixels = planes.size() / each;
        for (size_t pixel = 0; pixel < pixels; ++pixel)
            for (size_t word = 0; word < each; ++word)
                words.push_back(planes[word * pixels + pixel]);
    }
    return words;
}

void addWords(uint32_t* sum, const uint32_t* more, size_t count) {
    uint64_t carry = 0;
    for (size_t i = 0; i < count; ++i) {
        carry += uint64_t{sum[i]} + more[i];
        sum[i] = static_cast<uint32_t>(carry);
        carry >>= 32;
    }
}

RenderResult resultOf(Renderer& renderer) {
    renderer.render([](double) { return true; });
    return {renderer.rendering(), renderer.film().readTallies(), wordsOf(renderer.film())};
}

} // namespace

std::vector<Schedule> schedulesOf(const gpu::Device& device) {
    std::vector<Schedule> schedules{Schedule::fused, Schedule::wavefront};
    if (device.description().sharesMemory)
        schedules.push_back(Schedule::hosted);
    return schedules;
}

double shareThatDiffers(const Rendering& a, const Rendering& b) {
    const std::vector<glm::vec3>& pixels = a.radiance().pixels;
    size_t different = 0;
    for (size_t i = 0; i < pixels.size(); ++i)
        different +=
            glm::distance(pixels[i], b.radiance().pixels[i]) > 1e-5f * glm::length(pixels[i]) ? 1 : 0;
    return static_cast<double>(different) / static_cast<double>(pixels.size());
}

RenderSettings imageSettings(uint32_t width, uint32_t height, uint32_t samples) {
    RenderSettings settings;
    settings.image.width = width;
    settings.image.height = height;
    settings.stop.samples = samples;
    settings.estimator.sampler = Sampler::independent; // the film's variance is that of independent samples
    return settings;
}

RenderResult renderScene(gpu::Device& device, const Scene& scene, const RenderSettings& settings) {
    checkSettings(settings);
    // Never destroyed, as the device is not: at exit the validation layer may be unloaded before them.
    static auto& kept = *new std::optional<EstimatorKernels>;
    std::optional<EstimatorKernels> earlier = std::exchange(kept, std::nullopt);
    const Camera& camera = scene.cameras.front();
    Renderer renderer = earlier ? Renderer(device, scene, camera, settings, std::move(*earlier))
                                : Renderer(device, scene, camera, settings);
    RenderResult result = resultOf(renderer);
    kept.emplace(renderer.releaseKernels());
    return result;
}

RenderResult renderScene(gpu::Device& device, const Scene& scene, const RenderSettings& settings,
                         const KernelSource& kernels) {
    checkSettings(settings);
    Renderer renderer(device, scene, scene.cameras.front(), settings, kernels);
    return resultOf(renderer);
}

std::vector<uint32_t> sumOfFilms(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b,
                                 const FilmLayout& layout) {
    std::vector<uint32_t> sum = a;
    for (size_t pixel = 0; pixel < sum.size(); pixel += layout.words()) {
        for (const FilmNumber& number : layout.numbers())
            addWords(&sum[pixel + number.firstWord], &b[pixel + number.firstWord], number.words);
        sum[pixel + layout.countWord()] += b[pixel + layout.countWord()];
    }
    return sum;
}

ImageMean meanOf(const Rendering& rendering) {
    ImageMean result;
    for (size_t i = 0; i < rendering.radiance().pixels.size(); ++i) {
        result.mean += glm::dvec3(rendering.radiance().pixels[i]);
        result.standardError += glm::dvec3(rendering.variance().pixels[i]);
    }
    const auto n = static_cast<double>(rendering.radiance().pixels.size());
    result.mean /= n;
    result.standardError = glm::sqrt(result.standardError) / n;
    return result;
}

void expectMean(const RenderResult& result, const glm::dvec3& expected, double precision) {
    EXPECT_EQ(result.tallies.droppedSamples, 0u);
    const ImageMean image = meanOf(result.rendering);
    for (glm::length_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(image.mean[c], expected[c], kSigmas * image.standardError[c] + kRounding * expected[c])
            << "channel " << c << ", standard error " << image.standardError[c];
        EXPECT_LE(image.standardError[c], precision * expected[c]) << "too noisy to prove anything";
    }
}

void expectEveryPixel(const RenderResult& result, const glm::dvec3& expected) {
    EXPECT_EQ(result.tallies.droppedSamples, 0u);
    for (size_t i = 0; i < result.rendering.radiance().pixels.size(); ++i)
        for (glm::length_t c = 0; c < 3; ++c)
            ASSERT_NEAR(result.rendering.radiance().pixels[i][c], expected[c], kRounding * expected[c])
                << "pixel " << i << ", channel " << c;
}

void expectSameMean(const Rendering& a, const Rendering& b, uint32_t tileSize) {
    const uint32_t whole = std::max(a.radiance().width, a.radiance().height);
    for (const uint32_t size : {tileSize, whole}) {
        const WelchTest test =
            welchTest({&a.radiance(), &a.variance()}, {&b.radiance(), &b.variance()}, size);
        EXPECT_LT(test.maxAbsZ, kSigmas)
            << "tiles of " << size << ", worst at " << test.worstTile.x << ", " << test.worstTile.y
            << ", channel " << test.worstChannel << "; mean "
            << 100.0 * relativeMeanDifference(a.radiance(), b.radiance()).overall << " % apart";
    }
}

std::string writeDifference(const Image& a, const Image& b, float scale, const std::string& name) {
    std::vector<uint32_t> difference(a.pixels.size());
    for (size_t i = 0; i < difference.size(); ++i) {
        const glm::vec3 shown = glm::clamp(0.5f + scale * (a.pixels[i] - b.pixels[i]), 0.0f, 1.0f);
        const glm::uvec3 code(255.0f * shown + 0.5f);
        difference[i] = code.r | code.g << 8 | code.b << 16;
    }
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / (name + "-difference.png");
    writePng(path, a.width, a.height, difference);
    return path.string();
}

} // namespace lavalight::test
