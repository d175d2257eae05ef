// Directions of the BSDF are drawn with the density that its pdf says, and weighed by eval over pdf.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "shared/frame.h"
#include "support/chi_square.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "support/test_materials.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Push { // as in the kernels
    glm::vec3 wo;
    uint32_t material;
};

struct SampleAnswer { // as in bsdf_sample_test.comp
    glm::vec3 wi;
    float pdf;
    glm::vec3 weight;
    float pdfAgain;
    glm::vec3 f;
    float unused;
};

struct Question { // as in bsdf_test.comp
    glm::vec3 wo;
    uint32_t material;
    glm::vec3 wi;
    float unused;
};

struct Answer { // as in bsdf_test.comp
    glm::vec3 f;
    float pdf;
    glm::vec3 swapped;
    float unused;
};

constexpr size_t kSamples = 100000;
constexpr size_t kRings = 32; // from the zenith to the nadir
constexpr size_t kSectors = 32;
constexpr size_t kPointsPerSide = 16; // points of a bin for its integral, per side
constexpr size_t kPoints = kPointsPerSide * kPointsPerSide;
constexpr double kPi = std::numbers::pi;
constexpr double kWoAzimuth = 1.0;
constexpr double kMirrorAzimuth = kWoAzimuth + kPi;

const std::vector<float> kCosines = {1.0f, 0.8f, 0.3f, 0.05f};

glm::vec3 woAt(float cosTheta) {
    const float phi = kWoAzimuth;
    const float sinTheta = std::sqrt(1.0f - cosTheta * cosTheta);
    return {sinTheta * std::cos(phi), sinTheta * std::sin(phi), cosTheta};
}

// Bins are even in the polar angle and in the cube root of the azimuth counted from the mirror direction: at
// grazing angles lobes are only alpha times the cosine wide in azimuth.
double azimuthAt(double sector) {
    const double s = 2.0 * sector / kSectors - 1.0;
    return kMirrorAzimuth + kPi * s * s * s;
}

// The derivative d azimuth / d sector.
double azimuthStep(double sector) {
    const double s = 2.0 * sector / kSectors - 1.0;
    return 3.0 * kPi * s * s * 2.0 / kSectors;
}

// Bin of a direction.
size_t binOf(const glm::dvec3& w) {
    const double theta = std::acos(std::clamp(w.z, -1.0, 1.0));
    const double turn = std::remainder(std::atan2(w.y, w.x) - kMirrorAzimuth, 2.0 * kPi);
    const double sector = 0.5 * (std::cbrt(turn / kPi) + 1.0) * kSectors;
    const auto ring = std::min(static_cast<size_t>(theta / kPi * kRings), kRings - 1);
    return ring * kSectors + std::min(static_cast<size_t>(sector), kSectors - 1);
}

struct BinPoints {
    std::vector<glm::vec3> directions;
    std::vector<double> solidAngles;
};

// kPoints directions in every bin with the solid angles that they stand for.
BinPoints makeBinPoints() {
    const auto middle = [](size_t bin, size_t i) {
        return static_cast<double>(bin) + (static_cast<double>(i) + 0.5) / kPointsPerSide;
    };
    BinPoints points;
    for (size_t bin = 0; bin < kRings * kSectors; ++bin)
        for (size_t i = 0; i < kPoints; ++i) {
            const double theta = kPi * middle(bin / kSectors, i % kPointsPerSide) / kRings;
            const double sector = middle(bin % kSectors, i / kPointsPerSide);
            const double phi = azimuthAt(sector);
            points.directions.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                           std::cos(theta));
            points.solidAngles.push_back(std::sin(theta) * (kPi / kRings) * azimuthStep(sector) / kPoints);
        }
    return points;
}

std::vector<TestMaterial> joined(const std::vector<std::vector<TestMaterial>>& lists) {
    std::vector<TestMaterial> all;
    for (const std::vector<TestMaterial>& list : lists)
        all.insert(all.end(), list.begin(), list.end());
    return all;
}

class BsdfSampleTest : public DeviceTest {
  protected:
    // A runner of the named kernel over these materials.
    struct Bench {
        Bench(gpu::Device& device, const std::vector<TestMaterial>& list, const char* kernel,
              std::span<const gpu::SpecialisationConstant> constants = {})
            : materials(device, list),
              runner(device, test_kernels::find(kernel), materials.resources(), constants) {}
        MaterialBuffers materials;
        KernelRunner runner;
    };

    // Counts that the pdf makes one expect in each bin; the last bin is for all samples that are absorbed.
    static std::vector<double> expectedCounts(KernelRunner& eval, const BinPoints& points, const Push& push) {
        std::vector<Question> questions;
        for (const glm::vec3& wi : points.directions)
            questions.push_back({push.wo, push.material, wi, 0.0f});
        const std::vector<Answer> answers = eval.map<Answer>(questions);
        std::vector<double> expected(kRings * kSectors + 1);
        double sum = 0.0;
        for (size_t i = 0; i < answers.size(); ++i) {
            const double count = answers[i].pdf * points.solidAngles[i] * kSamples;
            expected[i / kPoints] += count;
            sum += count;
        }
        expected.back() = std::max(0.0, kSamples - sum);
        EXPECT_LE(sum, 1.003 * kSamples) << "the pdf integrates to more than one";
        return expected;
    }
    void expectDensities(const std::vector<TestMaterial>& materials,
                         std::span<const gpu::SpecialisationConstant> constants) {
        Bench eval(device(), materials, "bsdf_test", constants);
        Bench sample(device(), materials, "bsdf_sample_test", constants);
        const BinPoints points = makeBinPoints();
        for (uint32_t material = 0; material < materials.size(); ++material)
            for (const float cosTheta : kCosines) {
                SCOPED_TRACE(fmt::format("{}, cosine {}", materials[material].name, cosTheta));
                const Push push{woAt(cosTheta), material};
                const std::vector<double> expected = expectedCounts(eval.runner, points, push);
                EXPECT_GT(chiSquare(countSamples(sample.runner, push), expected).pValue, kLeastPValue);
            }
    }
    static std::vector<uint32_t> countSamples(KernelRunner& sample, const Push& push) {
        std::vector<uint32_t> counts(kRings * kSectors + 1);
        for (const SampleAnswer& answer : sample.generate<SampleAnswer>(kSamples, push))
            ++counts[answer.pdf > 0.0f ? binOf(answer.wi) : kRings * kSectors];
        return counts;
    }
};

// Samples of delta lobes count with those that are absorbed.
TEST_F(BsdfSampleTest, DirectionsHaveTheDensityThatThePdfSays) {
    const std::vector<TestMaterial> materials =
        joined({roughMaterials(), layeredMaterials(), tiltedCoats(), transmissiveMaterials(),
                solidMaterials(), smoothLayers()});
    expectDensities(materials, {});
}

TEST_F(BsdfSampleTest, MultipleScatteringHasItsDensityToo) {
    std::vector<TestMaterial> materials = joined({roughMaterials(), layeredMaterials()});
    std::erase_if(materials, [](const TestMaterial& material) { return material.record.metallic == 0.0f; });
    const std::vector<gpu::SpecialisationConstant> constants = {{CONSTANT_MULTIPLE_SCATTERING, 1}};
    expectDensities(materials, constants);
}

TEST_F(BsdfSampleTest, WeightTimesPdfIsEval) {
    const std::vector<TestMaterial> materials = joined(
        {roughMaterials(), layeredMaterials(), tiltedCoats(), transmissiveMaterials(), solidMaterials()});
    Bench sample(device(), materials, "bsdf_sample_test");
    for (uint32_t material = 0; material < materials.size(); ++material)
        for (const float cosTheta : kCosines) {
            SCOPED_TRACE(fmt::format("{}, cosine {}", materials[material].name, cosTheta));
            for (const SampleAnswer& a :
                 sample.runner.generate<SampleAnswer>(4096, Push{woAt(cosTheta), material})) {
                if (a.pdf == 0.0f) {
                    ASSERT_EQ(a.weight, glm::vec3(0.0f));
                    continue;
                }
                ASSERT_EQ(a.pdf, a.pdfAgain);
                const glm::vec3 product = a.weight * a.pdf;
                for (glm::length_t i = 0; i < 3; ++i)
                    ASSERT_NEAR(product[i], a.f[i], 1e-5f * a.f[i]);
            }
        }
}

TEST_F(BsdfSampleTest, SmoothMetalReflectsLikeAMirror) {
    const std::vector<TestMaterial> materials = smoothMaterials();
    Bench sample(device(), materials, "bsdf_sample_test");
    for (uint32_t material = 0; material < 2; ++material)
        for (const float cosTheta : kCosines) {
            SCOPED_TRACE(fmt::format("{}, cosine {}", materials[material].name, cosTheta));
            const glm::vec3 wo = woAt(cosTheta);
            const float grazing = std::pow(1.0f - cosTheta, 5.0f); // Schlick
            const glm::vec3 fresnel =
                glm::mix(materials[material].record.baseColor, glm::vec3(1.0f), grazing);
            for (const SampleAnswer& a : sample.runner.generate<SampleAnswer>(256, Push{wo, material})) {
                ASSERT_EQ(a.wi, glm::vec3(-wo.x, -wo.y, wo.z));
                ASSERT_EQ(a.pdf, 0.0f);
                for (glm::length_t i = 0; i < 3; ++i)
                    ASSERT_NEAR(a.weight[i], fresnel[i], 1e-5f);
            }
        }
}

} // namespace
} // namespace lavalight::test
