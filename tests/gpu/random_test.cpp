// Random numbers are uniform, independent between all parts of their key, and nothing but functions of it.
#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shared/frame.h"
#include "support/chi_square.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Key { // as in the kernel
    uint32_t seed = 0;
    uint32_t pixel = 0;
    uint32_t index = 0;
    uint32_t vertex = 0;
    uint32_t dimension = 0;
};
using Words = std::array<uint32_t, 2>;

constexpr uint32_t kImageWidth = 512;
constexpr uint32_t kDimensions = 6; // the first dimensions of lib/sampling/sampler.glsl

class RandomTest : public DeviceTest {
  protected:
    [[nodiscard]] std::vector<Words> words(const std::vector<Key>& keys) {
        const gpu::SpecialisationConstant independent{CONSTANT_SAMPLER, kSamplerIndependent};
        return KernelRunner(device(), test_kernels::find("random_test"), {}, {&independent, 1})
            .map<Words>(keys);
    }
};

// Every second pixel of 512 rows and columns, so that a pair with a neighbour shares no key with another
// pair.
std::vector<Key> everySecondPixel(Key key) {
    std::vector<Key> keys;
    for (uint32_t y = 0; y < kImageWidth; y += 2)
        for (uint32_t x = 0; x < kImageWidth; x += 2) {
            key.pixel = y * kImageWidth + x;
            keys.push_back(key);
        }
    return keys;
}

uint32_t bin(uint32_t word, uint32_t bits) {
    return word >> (32 - bits);
}

// p-value of the pairs (a[component], b[other]) over 32 x 32 bins.
double pairPValue(const std::vector<Words>& a, size_t component, const std::vector<Words>& b, size_t other) {
    std::vector<uint32_t> counts(32 * 32);
    for (size_t i = 0; i < a.size(); ++i)
        ++counts[bin(a[i][component], 5) * 32 + bin(b[i][other], 5)];
    return chiSquareUniform(counts).pValue;
}

TEST_F(RandomTest, EveryNumberIsUniformInOneDimension) {
    for (uint32_t dimension = 0; dimension < kDimensions; ++dimension)
        for (const uint32_t vertex : {0u, 1u, 2u, 7u, 64u}) {
            const auto all = words(everySecondPixel({1, 0, 3, vertex, dimension}));
            for (size_t component = 0; component < 2; ++component) {
                std::vector<uint32_t> high(256);
                std::vector<uint32_t> low(256);
                for (const Words& w : all) {
                    ++high[bin(w[component], 8)];
                    ++low[w[component] & 255u];
                }
                const std::string where = "dimension " + std::to_string(dimension) + " vertex " +
                                          std::to_string(vertex) + " component " + std::to_string(component);
                EXPECT_GT(chiSquareUniform(high).pValue, kLeastPValue) << where;
                EXPECT_GT(chiSquareUniform(low).pValue, kLeastPValue) << where << ", low bits";
            }
        }
}

TEST_F(RandomTest, SamplesOfOnePixelAreUniform) {
    std::vector<Key> keys;
    for (uint32_t index = 0; index < 65536; ++index)
        keys.push_back({0, 123456, index, 1, 2});
    const auto all = words(keys);
    std::vector<uint32_t> counts(256);
    for (const Words& w : all)
        ++counts[bin(w[0], 8)];
    EXPECT_GT(chiSquareUniform(counts).pValue, kLeastPValue);
    EXPECT_GT(pairPValue(all, 0, all, 1), kLeastPValue);
}

TEST_F(RandomTest, NumbersOfOneDimensionAreUniformTogether) {
    for (uint32_t dimension = 0; dimension < kDimensions; ++dimension) {
        const auto all = words(everySecondPixel({0, 0, 0, 1, dimension}));
        EXPECT_GT(pairPValue(all, 0, all, 1), kLeastPValue) << "dimension " << dimension;
    }
}

TEST_F(RandomTest, NeighboursInEveryPartOfTheKeyAreIndependent) {
    struct Neighbour {
        const char* name;
        std::function<void(Key&)> step;
    };
    const std::vector<Neighbour> neighbours = {
        {"next pixel", [](Key& k) { k.pixel += 1; }},
        {"pixel below", [](Key& k) { k.pixel += kImageWidth; }},
        {"next sample", [](Key& k) { k.index += 1; }},
        {"next vertex", [](Key& k) { k.vertex += 1; }},
        {"next dimension", [](Key& k) { k.dimension += 1; }},
        {"next seed", [](Key& k) { k.seed += 1; }},
    };
    const std::vector<Key> keys = everySecondPixel({0, 0, 4, 1, 1});
    const auto here = words(keys);
    for (const Neighbour& neighbour : neighbours) {
        std::vector<Key> stepped = keys;
        for (Key& key : stepped)
            neighbour.step(key);
        const auto there = words(stepped);
        for (size_t component = 0; component < 2; ++component)
            for (size_t other = 0; other < 2; ++other)
                EXPECT_GT(pairPValue(here, component, there, other), kLeastPValue)
                    << neighbour.name << ": components " << component << " and " << other;
    }
}

// pcg4d of Jarzynski and Olano 2020, written down once more.
Words pcg4d(std::array<uint32_t, 4> v) {
    for (uint32_t& x : v)
        x = x * 1664525u + 1013904223u;
    const auto mix = [&v] {
        v[0] += v[1] * v[3];
        v[1] += v[2] * v[0];
        v[2] += v[0] * v[1];
        v[3] += v[1] * v[2];
    };
    mix();
    for (uint32_t& x : v)
        x ^= x >> 16;
    mix();
    return {v[0], v[1]};
}

TEST_F(RandomTest, AKeyAloneDecidesItsNumbers) {
    std::vector<Key> keys = everySecondPixel({7, 0, 5, 3, 2});
    const auto once = words(keys);
    for (size_t i = 0; i < keys.size(); ++i)
        ASSERT_EQ(once[i], pcg4d({keys[i].pixel, keys[i].index, keys[i].vertex << 8 | keys[i].dimension,
                                  keys[i].seed}));
    std::reverse(keys.begin(), keys.end());
    auto reversed = words(keys);
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_EQ(once, reversed);
}

TEST_F(RandomTest, WordsBecomeNumbersThatNeverReachOne) {
    KernelRunner runner(device(), test_kernels::find("random_unit_test"));
    const auto numbers = runner.map<float>(std::vector<uint32_t>{0u, 255u, 256u, 0x80000000u, 0xffffffffu});
    EXPECT_EQ(numbers, (std::vector<float>{0.0f, 0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f}));
}

} // namespace
} // namespace lavalight::test
