// Visible normals of GGX are drawn with the density that their pdf says, and that density integrates to one.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "support/chi_square.h"
#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Push { // as in the kernel
    glm::vec3 wo;
    uint32_t wantsPdf;
    glm::vec2 alpha;
};

constexpr size_t kSamples = 100000;
constexpr size_t kRings = 20;
constexpr size_t kSectors = 32;
constexpr size_t kPointsPerSide = 12; // points of a bin for its integral, per side
constexpr double kPi = std::numbers::pi;

// Normals are binned as stretched to a surface of alpha 1: m' = normalize(m.xy / alpha, m.z), where no lobe
// is narrow.
glm::dvec3 stretched(const glm::vec3& m, const glm::dvec2& alpha) {
    return glm::normalize(glm::dvec3(glm::dvec2(m) / alpha, m.z));
}

struct Unstretched {
    glm::vec3 m;
    double solidAngle; // solid angle of m per solid angle of m'
};

Unstretched unstretched(double cosTheta, double phi, const glm::dvec2& alpha) {
    const double sinTheta = std::sqrt(1.0 - cosTheta * cosTheta);
    const glm::dvec3 m(alpha.x * sinTheta * std::cos(phi), alpha.y * sinTheta * std::sin(phi), cosTheta);
    const double length = glm::length(m);
    // A linear map A takes solid angles dw to |det A| / |A w|^3 dw.
    return {glm::vec3(m / length), alpha.x * alpha.y / (length * length * length)};
}

class MicrofacetTest : public DeviceTest {
  protected:
    void SetUp() override {
        DeviceTest::SetUp();
        runner_.emplace(device(), test_kernels::find("microfacet_test"));
    }
    std::vector<glm::vec4> ask(const std::vector<glm::vec4>& questions, const glm::vec3& wo,
                               const glm::vec2& alpha, bool wantsPdf) {
        const Push push{wo, wantsPdf ? 1u : 0u, alpha};
        return runner_->run<glm::vec4>(std::span<const glm::vec4>(questions), questions.size(),
                                       std::as_bytes(std::span(&push, 1)));
    }
    std::vector<uint32_t> countSamples(const glm::vec3& wo, const glm::vec2& alpha) {
        Random random(1);
        std::vector<glm::vec4> u(kSamples);
        for (glm::vec4& x : u)
            x = {random.unit(), random.unit(), 0.0f, 0.0f};
        std::vector<uint32_t> counts(kRings * kSectors);
        for (const glm::vec4& m : ask(u, wo, alpha, false)) {
            EXPECT_NEAR(glm::length(glm::vec3(m)), 1.0f, 1e-6f);
            const glm::dvec3 s = stretched(m, alpha);
            const double turn = std::atan2(s.y, s.x) / (2.0 * kPi);
            const auto ring = std::min(static_cast<size_t>(std::max(s.z, 0.0) * kRings), kRings - 1);
            const auto sector = static_cast<size_t>((turn < 0.0 ? turn + 1.0 : turn) * kSectors) % kSectors;
            ++counts[ring * kSectors + sector];
        }
        return counts;
    }
    std::vector<double> expectedCounts(const glm::vec3& wo, const glm::vec2& alpha) {
        constexpr size_t points = kPointsPerSide * kPointsPerSide;
        const auto middleOf = [](size_t bin, size_t point) {
            return static_cast<double>(bin) + (static_cast<double>(point) + 0.5) / kPointsPerSide;
        };
        std::vector<glm::vec4> normals;
        std::vector<double> weights;
        for (size_t bin = 0; bin < kRings * kSectors; ++bin)
            for (size_t i = 0; i < points; ++i) {
                const double ring = middleOf(bin / kSectors, i % kPointsPerSide);
                const double sector = middleOf(bin % kSectors, i / kPointsPerSide);
                const Unstretched u = unstretched(ring / kRings, 2.0 * kPi * sector / kSectors, alpha);
                normals.emplace_back(u.m, 0.0f);
                weights.push_back(u.solidAngle * 2.0 * kPi / (kRings * kSectors * points));
            }
        const std::vector<glm::vec4> pdfs = ask(normals, wo, alpha, true);
        std::vector<double> expected(kRings * kSectors);
        for (size_t i = 0; i < pdfs.size(); ++i)
            expected[i / points] += pdfs[i].x * weights[i] * kSamples;
        return expected;
    }

  private:
    std::optional<KernelRunner> runner_;
};

TEST_F(MicrofacetTest, VisibleNormalsHaveTheDensityThatTheirPdfSays) {
    for (const glm::vec2& alpha : {glm::vec2(0.002f), glm::vec2(0.05f), glm::vec2(0.3f), glm::vec2(1.0f),
                                   glm::vec2(0.5f, 0.1f), glm::vec2(1.0f, 0.02f), glm::vec2(0.1f, 0.4f)})
        for (const float cosTheta : {1.0f, 0.8f, 0.3f, 0.02f}) {
            const float sinTheta = std::sqrt(1.0f - cosTheta * cosTheta);
            const glm::vec3 wo(0.6f * sinTheta, -0.8f * sinTheta, cosTheta);
            const std::vector<double> expected = expectedCounts(wo, alpha);
            const std::string where = fmt::format("alpha {} {} cosine {}", alpha.x, alpha.y, cosTheta);
            double sum = 0.0;
            for (const double e : expected)
                sum += e / kSamples;
            EXPECT_NEAR(sum, 1.0, 2e-3) << where; // midpoints across the kink where normals turn away from wo
            EXPECT_GT(chiSquare(countSamples(wo, alpha), expected).pValue, kLeastPValue) << where;
        }
}

} // namespace
} // namespace lavalight::test
