// No surface reflects more than it receives, and white ones without losses reflect all of it.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "shared/frame.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "support/test_materials.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct Push { // as in the kernel
    glm::vec3 wo;
    uint32_t material;
};

constexpr size_t kBatches = 64;      // batches of 256 samples
constexpr size_t kManyBatches = 128; // where few samples carry much of the mean
// Standard errors. One in 31,000 means lies further above what it estimates by chance; here are some 3,000.
constexpr double kSigmas = 4.0;
// Error of a batch's sum in single precision: 256 roundings of up to half a unit in the last place of 256,
// in the mean of 1.
constexpr double kRounding = 3e-5;
const std::vector<gpu::SpecialisationConstant> kMultipleScattering = {{CONSTANT_MULTIPLE_SCATTERING, 1}};
const std::vector<float> kCosines = {1.0f, 0.9f, 0.7f, 0.5f, 0.3f, 0.2f, 0.1f, 0.05f, 0.02f, 0.005f, 0.002f};

std::vector<float> azimuthsOf(const MaterialRecord& record) {
    return record.anisotropy > 0.0f ? std::vector<float>{0.0f, 0.8f, 1.5707963f} : std::vector<float>{0.0f};
}

struct Albedo {
    glm::dvec3 mean{0.0};
    double standardError = 0.0; // standard error of the worst channel
};

class BsdfEnergyTest : public DeviceTest {
  protected:
    // Calls check(material, cosine, albedo) for all materials and angles.
    template <typename Check>
    void forEachAlbedo(const std::vector<TestMaterial>& materials, const Check& check,
                       std::span<const gpu::SpecialisationConstant> constants = {},
                       size_t batches = kBatches) {
        const MaterialBuffers buffers(device(), materials);
        KernelRunner runner(device(), test_kernels::find("bsdf_energy_test"), buffers.resources(), constants);
        for (uint32_t material = 0; material < materials.size(); ++material)
            for (const float azimuth : azimuthsOf(materials[material].record))
                for (const float cosTheta : kCosines) {
                    SCOPED_TRACE(fmt::format("{}, cosine {}, azimuth {}", materials[material].name, cosTheta,
                                             azimuth));
                    const float sinTheta = std::sqrt(1.0f - cosTheta * cosTheta);
                    const Push push{{sinTheta * std::cos(azimuth), sinTheta * std::sin(azimuth), cosTheta},
                                    material};
                    check(materials[material], cosTheta, albedoOf(runner.generate<glm::vec4>(batches, push)));
                }
    }

  private:
    static Albedo albedoOf(const std::vector<glm::vec4>& means) {
        glm::dvec3 sum(0.0);
        glm::dvec3 squares(0.0);
        for (const glm::vec4& mean : means) {
            sum += glm::dvec3(mean);
            squares += glm::dvec3(mean) * glm::dvec3(mean);
        }
        const double n = static_cast<double>(means.size());
        const glm::dvec3 variance = glm::max(squares / n - sum * sum / (n * n), 0.0) / (n - 1.0);
        return {sum / n, std::sqrt(std::max({variance.x, variance.y, variance.z}))};
    }
};

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

std::vector<TestMaterial> allMaterials() {
    std::vector<TestMaterial> all;
    for (const auto& list :
         {roughMaterials(), smoothMaterials(), layeredMaterials(), tiltedCoats(), transmissiveMaterials(),
          solidMaterials(), smoothLayers(), smoothFilms(), whitesOfAllRoughnesses()})
        all.insert(all.end(), list.begin(), list.end());
    return all;
}

TEST_F(BsdfEnergyTest, NoSurfaceReflectsMoreThanItReceives) {
    forEachAlbedo(allMaterials(), [](const TestMaterial&, float, const Albedo& albedo) {
        EXPECT_LE(largest(albedo.mean), 1.0 + kRounding + kSigmas * albedo.standardError);
    });
}

TEST_F(BsdfEnergyTest, MultipleScatteringAddsNoMoreThanIsLost) {
    std::vector<TestMaterial> metals = allMaterials();
    std::erase_if(metals, [](const TestMaterial& material) { return material.record.metallic == 0.0f; });
    forEachAlbedo(
        metals,
        [](const TestMaterial&, float, const Albedo& albedo) {
            EXPECT_LE(largest(albedo.mean), 1.0 + kRounding + kSigmas * albedo.standardError);
        },
        kMultipleScattering);
}

TEST_F(BsdfEnergyTest, WhiteMetalReflectsEverythingInTheEnd) {
    std::vector<TestMaterial> metals;
    for (const TestMaterial& material : allMaterials())
        if (material.name.starts_with("white metal") || material.name == "smooth white metal")
            metals.push_back(material);
    ASSERT_EQ(metals.size(), 8u);
    forEachAlbedo(
        metals,
        [](const TestMaterial&, float, const Albedo& albedo) {
            EXPECT_NEAR(albedo.mean.x, 1.0, 0.01 + 4.0 * albedo.standardError);
        },
        kMultipleScattering, kManyBatches);
    double least = 1.0;
    forEachAlbedo(metals, [&](const TestMaterial&, float, const Albedo& albedo) {
        least = std::min(least, albedo.mean.x);
    });
    EXPECT_LT(least, 0.5) << "appendix B loses so much: else nothing was to be made up for";
}

TEST_F(BsdfEnergyTest, WhiteLambertReflectsEverything) {
    forEachAlbedo({roughMaterials().front()}, [](const TestMaterial&, float, const Albedo& albedo) {
        EXPECT_NEAR(albedo.mean.x, 1.0, 1e-6);
        EXPECT_NEAR(albedo.mean.y, 1.0, 1e-6);
        EXPECT_NEAR(albedo.mean.z, 1.0, 1e-6);
    });
}

// What the coating does not reflect reaches the base, and the base returns it all.
TEST_F(BsdfEnergyTest, WhiteDielectricReflectsEverything) {
    std::vector<TestMaterial> whites;
    for (const TestMaterial& material : allMaterials())
        if (material.name.starts_with("white dielectric") || material.name == "smooth white dielectric")
            whites.push_back(material);
    ASSERT_EQ(whites.size(), 10u);
    forEachAlbedo(whites, [](const TestMaterial&, float, const Albedo& albedo) {
        EXPECT_NEAR(albedo.mean.x, 1.0, 0.01 + 4.0 * albedo.standardError);
    });
}

} // namespace
} // namespace lavalight::test
