// Sobol's samples are stratified as a (0,2)-sequence must be, scrambled anew for each pixel, and unbiased.
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "support/chi_square.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Push { // as in the kernel
    uint32_t firstPixel;
    uint32_t samplesEach;
    uint32_t vertex;
};

double unit(uint32_t word) {
    return word * 0x1p-32;
}

class SobolTest : public DeviceTest {
  protected:
    std::vector<glm::uvec4> samples(uint32_t pixel, uint32_t count) {
        return samplesOfPixels(pixel, 1, count);
    }
    std::vector<glm::uvec4> samplesOfPixels(uint32_t firstPixel, uint32_t pixels, uint32_t samplesEach) {
        return KernelRunner(device(), test_kernels::find("sobol_test"))
            .generate<glm::uvec4>(size_t{pixels} * samplesEach, Push{firstPixel, samplesEach, 1});
    }
    // Mean squared error of the mean of f over `count` samples of many pixels.
    template <typename Function>
    double meanSquaredError(uint32_t count, double exact, const Function& f) {
        constexpr uint32_t pixels = 64;
        const std::vector<glm::uvec4> all = samplesOfPixels(0, pixels, count);
        double sum = 0.0;
        for (uint32_t pixel = 0; pixel < pixels; ++pixel) {
            double mean = 0.0;
            for (const glm::uvec4& w : std::span(all).subspan(size_t{pixel} * count, count))
                mean += f(unit(w.x), unit(w.y)) / count;
            sum += (mean - exact) * (mean - exact) / pixels;
        }
        return sum;
    }
};

// Every way to cut the square into 2^m equal boxes with sides that are powers of two: one point in each box,
// for each aligned block of 2^m samples.
TEST_F(SobolTest, EveryAlignedBlockOfSamplesIsANet) {
    constexpr uint32_t m = 8;
    constexpr uint32_t block = 1u << m;
    const auto all = samples(4711, 4 * block);
    for (uint32_t first = 0; first < all.size(); first += block)
        for (uint32_t xBits = 0; xBits <= m; ++xBits) {
            std::vector<uint32_t> counts(block);
            for (uint32_t i = first; i < first + block; ++i) {
                const uint64_t x = uint64_t{all[i].x} << xBits >> 32;
                const uint64_t y = uint64_t{all[i].y} << (m - xBits) >> 32;
                ++counts[(x << (m - xBits)) + y];
            }
            EXPECT_EQ(counts, std::vector<uint32_t>(block, 1))
                << "block at " << first << ", x bits " << xBits;
        }
}

TEST_F(SobolTest, SingleNumbersAreStratified) {
    std::vector<uint32_t> counts(1024);
    for (const glm::uvec4& w : samples(99, 1024))
        ++counts[w.z >> 22];
    EXPECT_EQ(counts, std::vector<uint32_t>(1024, 1));
}

// Pairs and single numbers are padded, not one sequence: together they must look independent.
TEST_F(SobolTest, DimensionsAreIndependentOfOneAnother) {
    std::vector<uint32_t> counts(16 * 16);
    for (const glm::uvec4& w : samplesOfPixels(0, 64, 1024))
        ++counts[(w.x >> 28) * 16 + (w.z >> 28)];
    // Strata make the counts more even than chance, never less.
    EXPECT_GT(chiSquareUniform(counts).pValue, kLeastPValue);
}

TEST_F(SobolTest, PixelsAreDecorrelated) {
    std::vector<uint32_t> counts(16 * 16);
    const std::vector<glm::uvec4> first = samplesOfPixels(0, 8192, 1);
    for (size_t pixel = 0; pixel < first.size(); pixel += 2)
        ++counts[(first[pixel].x >> 28) * 16 + (first[pixel + 1].x >> 28)];
    EXPECT_GT(chiSquareUniform(counts).pValue, kLeastPValue);
}

// A smooth integrand over the square: Owen's scrambling converges as n^-1.5, independent samples as n^-0.5.
TEST_F(SobolTest, ErrorOfASmoothIntegrandFallsFasterThanByRandomSamples) {
    const double exact = (std::exp(1.0) - 1.0) * 2.0 / 3.14159265358979;
    const auto f = [](double x, double y) { return std::exp(x) * std::sin(3.14159265358979 * y); };
    const double few = meanSquaredError(64, exact, f);
    const double many = meanSquaredError(1024, exact, f);
    const double slope = 0.5 * std::log(many / few) / std::log(1024.0 / 64.0);
    EXPECT_LT(slope, -0.9);
    RecordProperty("slope", std::to_string(slope));
}

} // namespace
} // namespace lavalight::test
