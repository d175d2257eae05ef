// Environment maps: where directions lie in them, what they send, and that they are sampled by the density
// that MIS asks for.
#include <cmath>
#include <numbers>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "device_scene/gpu_scene.h"
#include "gpu/buffer.h"
#include "light/lights.h"
#include "render/renderer.h"
#include "support/chi_square.h"
#include "support/environment_maps.h"
#include "support/random_numbers.h"
#include "support/run_kernel.h"
#include "support/test_device.h"
#include "test_kernels.h"

namespace lavalight::test {
namespace {

using std::numbers::pi;

struct alignas(16) Answer { // as in the kernel
    glm::vec3 wi;
    float pdf;
    glm::vec3 radiance;
    float evaluatedPdf;
    glm::vec2 uv;
    glm::vec2 unused;
    glm::vec3 again;
    float unusedToo;
};

constexpr size_t kSamples = 400000;
constexpr float kQuarterTurn = 90.0f;

class EnvironmentTest : public DeviceTest {
  protected:
    std::vector<Answer> ask(const Image& map, bool isSampling, const std::vector<glm::vec4>& questions,
                            float rotation = 0.0f) {
        Scene scene;
        scene.environmentMap = {"test", map};
        scene.bounds = {glm::vec3(-1.0f), glm::vec3(1.0f)};
        const Lights lights = collectLights(scene, glm::vec3(1.0f), LightSelection::power);
        const GpuScene gpuScene(device(), packScene(scene, lights));
        gpu::ResourceTable resources;
        gpuScene.addTo(resources);
        RenderSettings settings;
        settings.image.width = 1;
        settings.lighting.rotation = rotation;
        FrameParameters frame = makeFrame(scene, Camera(), settings);
        setLights(frame, lights);
        gpu::Buffer uniforms(device(), "frame", sizeof frame, gpu::BufferUse::uniform);
        uniforms.upload(std::as_bytes(std::span(&frame, 1)));
        resources.set("Frame", uniforms);
        KernelRunner runner(device(), test_kernels::find("environment_test"), resources);
        const uint32_t push = isSampling ? 1 : 0;
        return runner.run<Answer>(std::span<const glm::vec4>(questions), questions.size(),
                                  std::as_bytes(std::span(&push, 1)));
    }
    std::vector<Answer> sample(const Image& map, float rotation = 0.0f) {
        Random random(1);
        std::vector<glm::vec4> questions(kSamples);
        for (glm::vec4& question : questions)
            question = {random.unit(), random.unit(), 0.0f, 0.0f};
        return ask(map, true, questions, rotation);
    }
};

std::vector<glm::vec4> randomDirections(size_t count) {
    Random random(2);
    std::vector<glm::vec4> directions;
    for (size_t i = 0; i < count; ++i)
        directions.emplace_back(random.direction(), 0.0f);
    return directions;
}

// Rounding of a point on a map of 1: of its angle tangent, which Mesa approximates by a polynomial.
constexpr double kPointError = 2e-6;

TEST_F(EnvironmentTest, DirectionsAndPointsOfTheMapAreInverse) {
    std::vector<glm::vec4> questions = randomDirections(10000);
    for (const float height : {-1.0f, 1.0f}) // close to the poles
        for (const float across : {1e-2f, 1e-4f, 1e-6f})
            questions.emplace_back(glm::normalize(glm::vec3(across, height, -0.5f * across)), 0.0f);
    const std::vector<Answer> answers = ask(constantMap(4, 2, glm::vec3(1.0f)), false, questions);
    for (size_t i = 0; i < answers.size(); ++i) {
        const glm::dvec2 expected = mapPoint(glm::dvec3(questions[i]));
        ASSERT_NEAR(answers[i].uv.x, expected.x, kPointError) << i;
        ASSERT_LT(glm::length(glm::dvec3(answers[i].again) - glm::dvec3(questions[i])),
                  2.0 * pi * kPointError)
            << i;
    }
}

TEST_F(EnvironmentTest, AxesLieWhereTheConventionSays) {
    const auto uvs = ask(constantMap(4, 2, glm::vec3(1.0f)), false,
                         {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, -1, 0, 0}});
    EXPECT_LT(glm::length(uvs[0].uv - glm::vec2(0.5f, 0.5f)), 1e-6f);
    EXPECT_LT(glm::length(uvs[1].uv - glm::vec2(0.75f, 0.5f)), 1e-6f);
    EXPECT_LT(glm::length(uvs[2].uv - glm::vec2(0.25f, 0.5f)), 1e-6f);
    EXPECT_LT(std::abs(uvs[3].uv.y - 0.0f), 1e-6f);
    EXPECT_LT(std::abs(uvs[4].uv.y - 1.0f), 1e-6f);
}

TEST_F(EnvironmentTest, LookupsAreBilinearWrappedInUAndClampedInV) {
    const Image map = randomMap(5, 4, 3);
    const std::vector<glm::vec4> questions = randomDirections(10000);
    const std::vector<Answer> answers = ask(map, false, questions);
    for (size_t i = 0; i < answers.size(); ++i) {
        const glm::dvec3 expected = mapLookup(map, mapPoint(glm::dvec3(questions[i])));
        ASSERT_LT(glm::length(glm::dvec3(answers[i].radiance) - expected), 1e-4) << i;
    }
}

// What is seen along +X comes to lie along -Z: a quarter turn, counter-clockwise seen from above.
TEST_F(EnvironmentTest, RotationTurnsTheMapCounterClockwiseSeenFromAbove) {
    const Image map = randomMap(16, 8, 4);
    const auto plain = ask(map, false, {{1, 0, 0, 0}, {0, 0, 1, 0}});
    const auto turned = ask(map, false, {{0, 0, -1, 0}, {1, 0, 0, 0}}, kQuarterTurn);
    for (size_t i = 0; i < 2; ++i)
        EXPECT_LT(glm::length(turned[i].radiance - plain[i].radiance), 1e-4f);
}

struct MapCase {
    const char* name;
    Image map;
    float rotation;
};

std::ostream& operator<<(std::ostream& out, const MapCase& map) {
    return out << map.name;
}

// Bins of half a texel's width and height, at whose borders the density may have kinks; within each, points
// of a grid.
constexpr size_t kParts = 2;
constexpr size_t kGrid = 4;

class EnvironmentSampling : public EnvironmentTest, public testing::WithParamInterface<MapCase> {
  protected:
    [[nodiscard]] size_t columns() const { return kParts * GetParam().map.width; }
    [[nodiscard]] size_t rows() const { return kParts * GetParam().map.height; }
    [[nodiscard]] double turns() const { return GetParam().rotation / 360.0; }

    [[nodiscard]] size_t binOf(const glm::vec3& wi) const {
        const glm::dvec2 uv = mapPoint(glm::dvec3(wi));
        const double u = uv.x + turns();
        const auto x = static_cast<size_t>((u - std::floor(u)) * static_cast<double>(columns()));
        const auto y = static_cast<size_t>(uv.y * static_cast<double>(rows()));
        return std::min(y, rows() - 1) * columns() + std::min(x, columns() - 1);
    }

    // Of each bin: the device's density for MIS, integrated by the midpoint rule over equal solid angles.
    [[nodiscard]] std::vector<double> probabilities() {
        std::vector<glm::vec4> directions;
        for (size_t y = 0; y < kGrid * rows(); ++y)
            for (size_t x = 0; x < kGrid * columns(); ++x) {
                const double u = (static_cast<double>(x) + 0.5) / static_cast<double>(kGrid * columns());
                const double cosTheta = glm::mix(cosineOf(y / kGrid), cosineOf(y / kGrid + 1),
                                                 (static_cast<double>(y % kGrid) + 0.5) / kGrid);
                directions.emplace_back(mapDirection({u - turns(), std::acos(cosTheta) / pi}), 0.0);
            }
        std::vector<double> list(rows() * columns(), 0.0);
        const std::vector<Answer> answers = ask(GetParam().map, false, directions, GetParam().rotation);
        for (size_t i = 0; i < answers.size(); ++i) {
            const size_t x = i % (kGrid * columns()) / kGrid;
            const size_t y = i / (kGrid * columns()) / kGrid;
            const double solidAngle =
                2.0 * pi / static_cast<double>(columns()) * (cosineOf(y) - cosineOf(y + 1));
            list[y * columns() + x] += answers[i].evaluatedPdf * solidAngle / (kGrid * kGrid);
        }
        return list;
    }

  private:
    // At the upper border of a row of bins.
    [[nodiscard]] double cosineOf(size_t row) const {
        return std::cos(pi * static_cast<double>(row) / static_cast<double>(rows()));
    }
};

TEST_P(EnvironmentSampling, DirectionsHaveTheDensityThatThePdfSays) {
    std::vector<uint32_t> counts(rows() * columns());
    for (const Answer& answer : sample(GetParam().map, GetParam().rotation)) {
        ASSERT_NEAR(glm::length(answer.wi), 1.0f, 1e-5f);
        ++counts[binOf(answer.wi)];
    }
    std::vector<double> expected;
    for (const double probability : probabilities())
        expected.push_back(probability * kSamples);
    EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), kSamples, 1e-4 * kSamples);
    EXPECT_GT(chiSquare(counts, expected).pValue, kLeastPValue);
}

TEST_P(EnvironmentSampling, LightOverPdfIntegratesToTheLightOfTheSphere) {
    const Image& map = GetParam().map;
    glm::dvec3 expected(0.0);
    constexpr size_t kSteps = 1024;
    for (size_t y = 0; y < kSteps; ++y)
        for (size_t x = 0; x < kSteps; ++x) {
            const glm::dvec2 uv((x + 0.5) / kSteps, (y + 0.5) / kSteps);
            expected += mapLookup(map, uv) * std::sin(pi * uv.y) * (2.0 * pi * pi / (kSteps * kSteps));
        }
    double sum = 0.0;
    double squares = 0.0;
    for (const Answer& answer : sample(map, GetParam().rotation)) {
        const double value = answer.radiance.y / answer.pdf;
        sum += value / kSamples;
        squares += value * value / kSamples;
    }
    const double standardError = std::sqrt(std::max(squares - sum * sum, 0.0) / kSamples);
    EXPECT_NEAR(sum, expected.y, 4.5 * standardError + 2e-4 * expected.y);
    EXPECT_LT(standardError, 0.01 * expected.y);
}

TEST_P(EnvironmentSampling, PdfOfMisIsThatOfSampling) {
    float largest = 0.0f;
    const std::vector<Answer> answers = sample(GetParam().map, GetParam().rotation);
    for (const Answer& answer : answers)
        largest = std::max(largest, answer.pdf);
    for (const Answer& answer : answers)
        ASSERT_NEAR(answer.evaluatedPdf, answer.pdf, 1e-4f * answer.pdf + 1e-5f * largest);
}

TEST_P(EnvironmentSampling, ThereIsDensityWhereThereIsLight) {
    for (const Answer& answer : ask(GetParam().map, false, randomDirections(kSamples), GetParam().rotation))
        ASSERT_TRUE(answer.evaluatedPdf > 0.0f || answer.radiance == glm::vec3(0.0f));
}

INSTANTIATE_TEST_SUITE_P(Maps, EnvironmentSampling,
                         testing::Values(MapCase{"random", randomMap(16, 8, 5), 0.0f},
                                         MapCase{"oddSizesTurned", randomMap(13, 7, 6), 77.0f},
                                         MapCase{"tall", randomMap(3, 9, 7), 0.0f},
                                         MapCase{"sun", sunMap(64, 32, {40, 9}, 1e5f, 1.0f), 30.0f},
                                         MapCase{"sunAtThePole", sunMap(16, 8, {0, 0}, 1e4f, 0.0f), 0.0f},
                                         MapCase{"oneTexel", constantMap(1, 1, glm::vec3(0.5f)), 10.0f}),
                         [](const auto& map) { return std::string(map.param.name); });

} // namespace
} // namespace lavalight::test
