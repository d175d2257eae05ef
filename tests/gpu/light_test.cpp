// Emitters are picked with the probabilities that their pmf says, and sampled with the density that is
// returned.
#include <cmath>
#include <numeric>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "light/lights.h"
#include "render/gpu_scene.h"
#include "shared/frame.h"
#include "support/chi_square.h"
#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

struct alignas(16) Answer { // as in the kernel
    glm::vec3 wi;
    float pdf;
    glm::vec3 radiance;
    uint32_t light;
    float pmf;
    float isDelta;
};

constexpr size_t kSamples = 400000;

// Triangles of one emissive material each, facing the origin from above, of areas and radiances over five
// decades.
Scene scatteredLights(size_t count) {
    Random random(1);
    Scene scene;
    for (uint32_t i = 0; i < count; ++i) {
        Material material;
        material.emission = glm::vec3(std::pow(10.0f, random.between(-2.0f, 2.0f)));
        scene.materials.push_back(material);
        const glm::vec3 p(random.between(-2.0f, 2.0f), random.between(-2.0f, 2.0f),
                          random.between(1.0f, 3.0f));
        const float size = random.between(0.05f, 1.0f);
        scene.meshes.push_back(
            {"light", i, {p, p + glm::vec3(0, size, 0), p + glm::vec3(size, 0, 0)}, {}, {{0, 1, 2}}});
    }
    return scene;
}

// Signed solid angle of a triangle as seen from the origin. Van Oosterom, Strackee, "The Solid Angle of a
// Plane Triangle", 1983, eq. 8.
double solidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    return 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                            la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

// Over kSamples samples.
struct SampleSums {
    double sum = 0.0;
    double squares = 0.0;
    void add(double value) {
        sum += value;
        squares += value * value;
    }
    [[nodiscard]] double mean() const { return sum / kSamples; }
    [[nodiscard]] double variance() const { return squares / kSamples - mean() * mean(); }
};

class LightTest : public DeviceTest {
  protected:
    std::vector<Answer> sample(const Scene& scene, const glm::vec3& from) {
        const GpuScene gpuScene(device(), scene, scene.environment, LightSelection::power);
        gpu::ResourceTable resources;
        gpuScene.addTo(resources);
        KernelRunner runner(device(), test_kernels::find("light_test"), resources);
        FrameParameters frame{};
        frame.cameraPosition = from;
        frame.lightCount = gpuScene.lightCount();
        frame.environment = scene.environment;
        frame.sceneCenter = scene.bounds.center();
        frame.sceneRadius = scene.bounds.radius();
        return runner.generate<Answer>(kSamples, frame);
    }
};

TEST_F(LightTest, LightsArePickedByTheirPmf) {
    const Scene scene = scatteredLights(100);
    const Lights lights = collectLights(scene, glm::vec3(0.0f), LightSelection::power);
    const double totalPower = std::accumulate(lights.powers.begin(), lights.powers.end(), 0.0);
    std::vector<uint32_t> counts(lights.table.size());
    for (const Answer& answer : sample(scene, glm::vec3(0.0f))) {
        ASSERT_LT(answer.light, counts.size());
        ASSERT_EQ(answer.pmf, lights.table[answer.light].pmf);
        ++counts[answer.light];
    }
    std::vector<double> byPmf;
    std::vector<double> byPower;
    for (size_t i = 0; i < counts.size(); ++i) {
        byPmf.push_back(double{lights.table[i].pmf} * kSamples);
        byPower.push_back(lights.powers[i] / totalPower * kSamples);
    }
    EXPECT_GT(chiSquare(counts, byPmf).pValue, kLeastPValue);
    EXPECT_GT(chiSquare(counts, byPower).pValue, kLeastPValue);
}

// The mean of emission / pdf is the integral of radiance over the directions of the light, in closed form.
TEST_F(LightTest, EmissionOverPdfIntegratesToRadianceTimesSolidAngle) {
    const glm::vec3 from(0.3f, -0.2f, 0.1f);
    const Scene scene = scatteredLights(8);
    double expected = 0.0;
    for (const Mesh& mesh : scene.meshes)
        expected +=
            std::abs(solidAngle(glm::dvec3(mesh.positions[0] - from), glm::dvec3(mesh.positions[1] - from),
                                glm::dvec3(mesh.positions[2] - from))) *
            scene.materials[mesh.material].emission.x;
    SampleSums sums;
    for (const Answer& answer : sample(scene, from)) {
        ASSERT_NEAR(glm::length(answer.wi), 1.0f, 1e-5f);
        sums.add(answer.radiance.x / answer.pdf);
    }
    const double standardError = std::sqrt(sums.variance() / kSamples);
    EXPECT_NEAR(sums.mean(), expected, 4.0 * standardError);
    EXPECT_LT(standardError, 0.005 * expected); // the comparison means something
}

// Irradiance at a hundredth of the light's width below its middle: by area, the few points right above carry
// it all.
TEST_F(LightTest, NearALargeQuadTheVarianceIsATenthOfThatOfAreaSampling) {
    constexpr float kDistance = 0.01f; // of a square with sides of 1
    Material material;
    material.emission = glm::vec3(1.0f);
    Scene scene;
    scene.materials.push_back(material);
    scene.meshes.push_back({"quad",
                            0,
                            {{-0.5f, -0.5f, kDistance},
                             {-0.5f, 0.5f, kDistance},
                             {0.5f, 0.5f, kDistance},
                             {0.5f, -0.5f, kDistance}},
                            {},
                            {{0, 1, 2}, {0, 2, 3}}});
    SampleSums ours;
    for (const Answer& answer :
         sample(scene, {0.03f, 0.01f, 0.0f})) // off the diagonal, which has no density of its own
        ours.add(answer.radiance.x * std::max(answer.wi.z, 0.0f) / answer.pdf);
    SampleSums byArea;
    Random random(3);
    for (size_t i = 0; i < kSamples; ++i) {
        const glm::dvec3 d(random.unit() - 0.53, random.unit() - 0.51, kDistance);
        const double distance2 = glm::dot(d, d);
        byArea.add(kDistance * kDistance /
                   (distance2 * distance2)); // both cosines over distance^2; the area is 1
    }
    EXPECT_NEAR(ours.mean(), byArea.mean(),
                4.0 * std::sqrt((ours.variance() + byArea.variance()) / kSamples));
    EXPECT_LT(ours.variance(), 0.1 * byArea.variance()) << "area: " << byArea.variance();
}

TEST_F(LightTest, SingleSidedEmittersDoNotShineBackwards) {
    for (const Answer& answer : sample(scatteredLights(8), {0.0f, 0.0f, 5.0f}))
        ASSERT_EQ(answer.radiance, glm::vec3(0.0f));
}

} // namespace
} // namespace lavalight::test
