// Emitters are picked with the probabilities that their pmf says, and sampled
// with the density that is returned.
#include <cmath>
#include <numeric>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "device_scene/gpu_scene.h"
#include "device_scene/scene_features.h"
#include "light/lights.h"
#include "render/renderer.h"
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
    float evaluatedPmf;
    float place;
    float isDelta;
};

constexpr size_t kSamples = 400000;

// Triangles of one emissive material each, facing the origin from above, of
// areas and radiances over five decades.
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

// Signed solid angle of a triangle as seen from the origin. Van Oosterom,
// Strackee, "The Solid Angle of a Plane Triangle", 1983, eq. 8.
double solidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    return 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                            la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la);
}

// Sums over kSamples samples.
struct SampleSums {
    double sum = 0.0;
    double squares = 0.0;
    void add(const Answer& answer, double cosine = 1.0) {
        const double value = answer.pdf > 0.0f ? answer.radiance.x * cosine / answer.pdf : 0.0;
        add(value);
    }
    void add(double value) {
        sum += value;
        squares += value * value;
    }
    [[nodiscard]] double mean() const { return sum / kSamples; }
    [[nodiscard]] double variance() const { return squares / kSamples - mean() * mean(); }
};

class LightTest : public DeviceTest {
  protected:
    std::vector<Answer> sample(const Scene& scene, const glm::vec3& from,
                               LightSelection selection = LightSelection::power) {
        const Lights lights = collectLights(scene, scene.environment, selection);
        const GpuScene gpuScene(device(), packScene(scene, lights));
        gpu::ResourceTable resources;
        gpuScene.addTo(resources);
        FrameParameters frame{};
        frame.cameraPosition = from;
        frame.cameraUp = {0.0f, 0.0f, 1.0f}; // the receiver's normal
        setLights(frame, lights);
        frame.sceneCenter = scene.bounds.center();
        frame.sceneRadius = scene.bounds.radius();
        gpu::Buffer uniforms(device(), "frame", sizeof frame, gpu::BufferUse::uniform);
        uniforms.upload(std::as_bytes(std::span(&frame, 1)));
        resources.set("Frame", uniforms);
        const auto features = featureConstants(sceneFeatures(scene, lights));
        KernelRunner runner(device(), test_kernels::find("light_test"), resources, features);
        const uint32_t bothSides = 0;
        return runner.generate<Answer>(kSamples, bothSides);
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

// Lamps of all kinds around the origin: two-sided panels, point lights, spots,
// a sun and a sky.
Scene lampsOfAllKinds() {
    Scene scene = scatteredLights(60);
    Random random(7);
    for (Material& material : scene.materials)
        material.doubleSided = random.unit() < 0.5f;
    for (int i = 0; i < 30; ++i) {
        PunctualLight light;
        light.kind = i % 3 == 0 ? PunctualKind::spot : PunctualKind::point;
        light.position = {random.between(-3.0f, 3.0f), random.between(-3.0f, 3.0f),
                          random.between(-3.0f, 3.0f)};
        light.direction =
            glm::normalize(glm::vec3(random.between(-1.0f, 1.0f), random.between(-1.0f, 1.0f), 0.7f));
        light.innerConeAngle = 0.2f;
        light.outerConeAngle = random.between(0.3f, 1.5f);
        scene.punctualLights.push_back(light);
    }
    PunctualLight sun;
    sun.kind = PunctualKind::directional;
    scene.punctualLights.insert(scene.punctualLights.begin() + 4, sun);
    scene.environment = glm::vec3(0.1f);
    scene.bounds = {glm::vec3(-3.0f), glm::vec3(3.0f)};
    return scene;
}

TEST_F(LightTest, TheTreePicksLightsByTheirPmfWhichMisEvaluatesToTheBit) {
    const std::vector<Answer> answers = sample(lampsOfAllKinds(), {0.1f, 0.2f, -0.3f}, LightSelection::tree);
    std::vector<uint32_t> counts(92);
    std::vector<double> expected(92, 0.0);
    std::vector<uint32_t> places(64);
    uint32_t nothing = 0; // the way led to lights that all bring nothing
    for (const Answer& answer : answers) {
        nothing += answer.pmf == 0.0f ? 1 : 0;
        if (answer.pmf == 0.0f)
            continue;
        ASSERT_LT(answer.light, counts.size());
        ASSERT_EQ(answer.pmf, answer.evaluatedPmf) << "light " << answer.light;
        ++counts[answer.light];
        expected[answer.light] = double{answer.pmf} * kSamples;
        ASSERT_LT(answer.place, 1.0f);
        ++places[static_cast<size_t>(answer.place * 64.0f)];
    }
    const double picked = std::accumulate(expected.begin(), expected.end(), 0.0);
    EXPECT_LT(nothing, 0.1 * kSamples);
    counts.push_back(nothing);
    expected.push_back(kSamples - picked); // lights that were never picked have little
    EXPECT_GT(chiSquare(counts, expected).pValue, kLeastPValue);
    EXPECT_GT(chiSquare(places, std::vector<double>(64, (kSamples - nothing) / 64.0)).pValue, kLeastPValue);
    EXPECT_NEAR(expected[90] / kSamples, 16.0 / 33.0,
                1e-6); // the sun; the sky is the last
    EXPECT_NEAR(expected[91] / kSamples, 1.0 / 33.0, 1e-6);
}

// The mean of emission / pdf is the integral of radiance over the directions of
// the light, in closed form.
TEST_F(LightTest, EmissionOverPdfIntegratesToRadianceTimesSolidAngle) {
    const glm::vec3 from(0.3f, -0.2f, 0.1f);
    const Scene scene = scatteredLights(8);
    double expected = 0.0;
    for (const Mesh& mesh : scene.meshes)
        expected +=
            std::abs(solidAngle(glm::dvec3(mesh.positions[0] - from), glm::dvec3(mesh.positions[1] - from),
                                glm::dvec3(mesh.positions[2] - from))) *
            scene.materials[mesh.material].emission.x;
    for (const LightSelection selection : {LightSelection::power, LightSelection::tree}) {
        SampleSums sums;
        for (const Answer& answer : sample(scene, from, selection)) {
            ASSERT_NEAR(glm::length(answer.wi), 1.0f, 1e-5f);
            sums.add(answer);
        }
        const double standardError = std::sqrt(sums.variance() / kSamples);
        EXPECT_NEAR(sums.mean(), expected, 4.0 * standardError);
        EXPECT_LT(standardError,
                  0.005 * expected); // the comparison means something
    }
}

// The nearest of equal lamps strewn over a plane bring nearly all light.
TEST_F(LightTest, UnderManyLampsTheTreeHasASeventiethOfTheVarianceOfPickingByPower) {
    Random random(5);
    Scene scene;
    for (int i = 0; i < 1000; ++i) {
        PunctualLight light;
        light.position = {random.between(-30.0f, 30.0f), random.between(-30.0f, 30.0f), 0.5f};
        scene.punctualLights.push_back(light);
    }
    scene.bounds = {glm::vec3(-30.0f), glm::vec3(30.0f)};
    const auto irradiance = [&](LightSelection selection) {
        SampleSums sums;
        for (const Answer& answer : sample(scene, glm::vec3(0.0f), selection))
            sums.add(answer, std::max(answer.wi.z, 0.0f));
        return sums;
    };
    const SampleSums byPower = irradiance(LightSelection::power);
    const SampleSums byTree = irradiance(LightSelection::tree);
    EXPECT_NEAR(byTree.mean(), byPower.mean(),
                4.0 * std::sqrt((byTree.variance() + byPower.variance()) / kSamples));
    EXPECT_LT(byTree.variance(), byPower.variance() / 70.0)
        << "by power: " << byPower.variance() << ", tree: " << byTree.variance();
}

// KHR_lights_punctual's window, and no light from beyond a range; the tree passes by what ends before the
// point, so that it has less variance than picking by power.
TEST_F(LightTest, LampsWithRangesBringTheSumOfTheirWindows) {
    Random random(11);
    Scene scene;
    double expected = 0.0;
    for (int i = 0; i < 500; ++i) {
        PunctualLight light;
        light.position = {random.between(-9.0f, 9.0f), random.between(-9.0f, 9.0f),
                          random.between(0.2f, 3.0f)};
        light.range = i % 50 == 0 ? kNoRange : random.between(0.5f, 8.0f);
        scene.punctualLights.push_back(light);
        const double distance = glm::length(glm::dvec3(light.position));
        const double window = 1.0 - std::pow(distance / double{light.range}, 4.0);
        expected += std::max(0.0, window) / (distance * distance);
    }
    scene.bounds = {glm::vec3(-9.0f), glm::vec3(9.0f)};
    double variances[2] = {};
    for (const LightSelection selection : {LightSelection::power, LightSelection::tree}) {
        SampleSums sums;
        for (const Answer& answer : sample(scene, glm::vec3(0.0f), selection)) {
            const auto& lamp = scene.punctualLights.at(answer.light);
            if (answer.pmf > 0.0f && glm::length(lamp.position) >= lamp.range) {
                ASSERT_EQ(answer.radiance, glm::vec3(0.0f)) << "light " << answer.light;
            }
            if (selection == LightSelection::tree && answer.pmf > 0.0f) {
                ASSERT_EQ(answer.pmf, answer.evaluatedPmf);
            }
            sums.add(answer);
        }
        EXPECT_NEAR(sums.mean(), expected, 4.0 * std::sqrt(sums.variance() / kSamples));
        variances[selection == LightSelection::tree ? 1 : 0] = sums.variance();
    }
    EXPECT_LT(variances[1], 0.25 * variances[0])
        << "by power: " << variances[0] << ", tree: " << variances[1];
}

// Irradiance at a hundredth of the light's width below its middle: by area, the
// few points right above carry it all.
TEST_F(LightTest, NearALargeQuadTheVarianceIsATenthOfThatOfAreaSampling) {
    constexpr float kDistance = 0.01f; // distance from a square with sides of 1
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
        ours.add(answer, std::max(answer.wi.z, 0.0f));
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
