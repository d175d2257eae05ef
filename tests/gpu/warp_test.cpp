// Each warp draws what its density says, and each density integrates to one.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "support/chi_square.h"
#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

enum class Warp : uint32_t { disk, cosineHemisphere, triangle, linear }; // as in the kernel

struct Answer { // as in the kernel
    glm::vec3 point;
    float pdfOfQuestion;
};

constexpr size_t kSamples = 200000;
constexpr size_t kRings = 16;
constexpr size_t kSectors = 32;
constexpr double kPi = std::numbers::pi;

class WarpTest : public DeviceTest {
  protected:
    std::vector<Answer> ask(Warp warp, const std::vector<glm::vec4>& questions) {
        KernelRunner runner(device(), test_kernels::find("warp_test"));
        return runner.run<Answer>(std::span<const glm::vec4>(questions), questions.size(),
                                  std::as_bytes(std::span(&warp, 1)));
    }
    std::vector<Answer> sample(Warp warp) {
        Random random(1);
        std::vector<glm::vec4> u(kSamples);
        for (glm::vec4& x : u)
            x = {random.unit(), random.unit(), 0.0f, 0.0f};
        return ask(warp, u);
    }
    // The density at these points.
    std::vector<double> pdfs(Warp warp, const std::vector<glm::vec4>& points) {
        std::vector<double> values;
        for (const Answer& answer : ask(warp, points))
            values.push_back(answer.pdfOfQuestion);
        return values;
    }
};

// The one of `bins` bins of [0, 1] that `x` is in.
size_t binOf(double x, size_t bins) {
    return std::min(static_cast<size_t>(std::max(x, 0.0) * static_cast<double>(bins)), bins - 1);
}

size_t sectorOf(const glm::vec3& p) {
    return binOf(std::atan2(p.y, p.x) / (2.0 * kPi) + 0.5, kSectors);
}

TEST_F(WarpTest, DiskHasTheDensityThatItsPdfSays) {
    std::vector<uint32_t> counts(kRings * kSectors);
    for (const Answer& answer : sample(Warp::disk)) {
        const double radius2 = glm::dot(answer.point, answer.point);
        ASSERT_LE(radius2, 1.0 + 1e-6);
        ++counts[binOf(radius2, kRings) * kSectors + sectorOf(answer.point)];
    }
    const double pdf = pdfs(Warp::disk, {glm::vec4(0.0f)}).front();
    EXPECT_NEAR(pdf * kPi, 1.0, 1e-6); // area of the disk
    const double binArea = kPi / static_cast<double>(counts.size());
    const std::vector<double> expected(counts.size(), pdf * binArea * kSamples);
    EXPECT_GT(chiSquare(counts, expected).pValue, kLeastPValue);
}

TEST_F(WarpTest, CosineHemisphereHasTheDensityThatItsPdfSays) {
    std::vector<uint32_t> counts(kRings * kSectors);
    for (const Answer& answer : sample(Warp::cosineHemisphere)) {
        ASSERT_NEAR(glm::length(answer.point), 1.0f, 1e-6f);
        ++counts[binOf(answer.point.z, kRings) * kSectors + sectorOf(answer.point)];
    }
    // The density is linear in the cosine, so the midpoint rule is exact.
    std::vector<glm::vec4> middles;
    for (size_t ring = 0; ring < kRings; ++ring)
        middles.emplace_back(0.0f, 0.0f, (static_cast<float>(ring) + 0.5f) / kRings, 0.0f);
    const std::vector<double> pdf = pdfs(Warp::cosineHemisphere, middles);
    std::vector<double> expected;
    for (size_t i = 0; i < counts.size(); ++i)
        expected.push_back(pdf[i / kSectors] * 2.0 * kPi / static_cast<double>(counts.size()) * kSamples);
    EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), kSamples, 1e-5 * kSamples);
    EXPECT_GT(chiSquare(counts, expected).pValue, kLeastPValue);
    EXPECT_EQ(pdfs(Warp::cosineHemisphere, {{0.0f, 0.0f, -0.5f, 0.0f}}).front(), 0.0);
}

// The unit right triangle in n^2 congruent ones: squares of a grid, cut along their diagonals.
TEST_F(WarpTest, TriangleHasTheDensityThatItsPdfSays) {
    constexpr size_t n = 20;
    std::vector<uint32_t> counts(2 * n * n);
    for (const Answer& answer : sample(Warp::triangle)) {
        const glm::dvec2 b(answer.point);
        ASSERT_GE(b.x, 0.0);
        ASSERT_GE(b.y, 0.0);
        ASSERT_LE(b.x + b.y, 1.0 + 1e-6);
        const size_t column = binOf(b.x, n);
        const size_t row = binOf(b.y, n);
        const glm::dvec2 within = b * static_cast<double>(n) - glm::dvec2(column, row);
        const bool isUpper =
            within.x + within.y > 1.0 && column + row + 1 < n; // no half beyond the hypotenuse
        ++counts[2 * (row * n + column) + (isUpper ? 1 : 0)];
    }
    const double pdf = pdfs(Warp::triangle, {glm::vec4(0.0f)}).front();
    EXPECT_NEAR(pdf * 0.5, 1.0, 1e-6); // area of the triangle
    std::vector<double> expected(counts.size(), 0.0);
    for (size_t row = 0; row < n; ++row)
        for (size_t column = 0; column + row < n; ++column)
            for (size_t half = 0; half < 2; ++half)
                expected[2 * (row * n + column) + half] =
                    half == 1 && column + row + 1 == n ? 0.0 : pdf * 0.5 / (n * n) * kSamples;
    EXPECT_GT(chiSquare(counts, expected).pValue, kLeastPValue);
}

TEST_F(WarpTest, LinearHasTheDensityThatItsPdfSays) {
    constexpr size_t kBins = 50;
    for (const glm::vec2 ends : {glm::vec2(0.2f, 1.0f), glm::vec2(3.0f, 0.0f), glm::vec2(0.0f, 1e30f),
                                 glm::vec2(2.0f, 2.0f), glm::vec2(0.0f, 0.0f)}) {
        Random random(1);
        std::vector<glm::vec4> u;
        for (size_t i = 0; i < kSamples; ++i)
            u.emplace_back(random.unit(), 0.0f, ends.x, ends.y);
        std::vector<uint32_t> counts(kBins);
        for (const Answer& answer : ask(Warp::linear, u)) {
            ASSERT_TRUE(answer.point.x >= 0.0f && answer.point.x <= 1.0f) << answer.point.x;
            ++counts[binOf(answer.point.x, kBins)];
        }
        std::vector<glm::vec4> middles; // the density is linear, so the midpoint rule is exact
        for (size_t i = 0; i < kBins; ++i)
            middles.emplace_back((static_cast<float>(i) + 0.5f) / kBins, 0.0f, ends.x, ends.y);
        std::vector<double> expected;
        for (const double pdf : pdfs(Warp::linear, middles))
            expected.push_back(pdf / kBins * kSamples);
        EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), kSamples, 1e-5 * kSamples);
        EXPECT_GT(chiSquare(counts, expected).pValue, kLeastPValue) << ends.x << " to " << ends.y;
    }
}

TEST_F(WarpTest, CornersOfTheSquareStayInTheDomain) {
    std::vector<glm::vec4> u;
    for (const float x : {0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f})
        for (const float y : {0.0f, 0x1p-24f, 0.5f, 1.0f - 0x1p-24f})
            u.emplace_back(x, y, 0.0f, 0.0f);
    for (const Answer& answer : ask(Warp::disk, u))
        EXPECT_LE(glm::length(answer.point), 1.0f + 1e-6f);
    for (const Answer& answer : ask(Warp::cosineHemisphere, u)) {
        EXPECT_NEAR(glm::length(answer.point), 1.0f, 1e-6f);
        EXPECT_GE(answer.point.z, 0.0f);
    }
    for (const Answer& answer : ask(Warp::triangle, u)) {
        EXPECT_GE(answer.point.x, 0.0f);
        EXPECT_GE(answer.point.y, 0.0f);
        EXPECT_LE(answer.point.x + answer.point.y, 1.0f);
    }
}

} // namespace
} // namespace lavalight::test
