// What makes less noise does, by as much as is claimed; and the error that a render reports of itself is its
// error.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

#include "compare/statistics.h"
#include "image/exr.h"
#include "render/renderer.h"
#include "session/builtin.h"
#include "support/render_scene.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kSide = 32;

// The stored image of the Cornell box by another renderer, with half a million samples for each of our
// pixels.
Image cornellBoxReference() {
    const ExrFile file =
        readExr(std::filesystem::path(LAVALIGHT_SOURCE_DIR) / "tests/references/cornell-box.exr");
    return downsample({file.radiance, file.variance.value(), file.sampleCounts.value()},
                      file.radiance.width / kSide)
        .radiance;
}

// Of the variance of a pixel's mean, over channels and the pixels that see no light themselves: the edge of a
// light is noise that no estimator of illumination changes.
double illuminationVariance(const Rendering& rendering, const Image& emission) {
    double sum = 0.0;
    size_t pixels = 0;
    for (uint32_t y = 1; y + 1 < emission.height; ++y)
        for (uint32_t x = 1; x + 1 < emission.width; ++x) {
            bool seesLight = false;
            for (uint32_t j = y - 1; j <= y + 1; ++j)
                for (uint32_t i = x - 1; i <= x + 1; ++i)
                    seesLight = seesLight || emission.at(i, j) != glm::vec3(0.0f);
            if (seesLight)
                continue;
            const glm::vec3 variance = rendering.variance.at(x, y);
            sum += (double{variance.x} + double{variance.y} + double{variance.z}) / 3.0;
            ++pixels;
        }
    return sum / static_cast<double>(pixels);
}

class ConvergenceTest : public DeviceTest {
  protected:
    [[nodiscard]] Rendering render(const std::string& scene, const RenderSettings& settings) {
        return renderScene(device(), loadScene(scene), settings).rendering;
    }

    // Mean over 16 seeds of the mean squared error to the reference.
    [[nodiscard]] double squaredError(Sampler sampler, const Image& reference) {
        constexpr uint32_t kSeeds = 16;
        RenderSettings settings = imageSettings(kSide, kSide, 256);
        settings.estimator.sampler = sampler;
        double sum = 0.0;
        for (uint32_t seed = 0; seed < kSeeds; ++seed) {
            settings.estimator.seed = seed;
            sum += std::pow(rmse(render("cornell-box", settings).radiance, reference), 2.0) / kSeeds;
        }
        return sum;
    }
};

TEST_F(ConvergenceTest, SobolBeatsIndependentOnTheCornellBox) {
    const Image reference = cornellBoxReference();
    const double independent = squaredError(Sampler::independent, reference);
    const double sobol = squaredError(Sampler::sobol, reference);
    std::cout << "mean squared error at 256 samples: independent " << independent << ", sobol " << sobol
              << ", ratio " << independent / sobol << "\n";
    EXPECT_GT(independent, 1.5 * sobol);
}

TEST_F(ConvergenceTest, SelectionByPowerHasAThirdOfTheVarianceOfUniformAmongManyLights) {
    RenderSettings settings = imageSettings(64, 64, 1);
    settings.estimator.maxBounces = 0;
    settings.stop.samples = 64;
    const Image emission = render("many-lights", settings).radiance;
    settings = imageSettings(64, 64, 256);
    const double power = illuminationVariance(render("many-lights", settings), emission);
    settings.estimator.lightSelection = LightSelection::uniform;
    const double uniform = illuminationVariance(render("many-lights", settings), emission);
    std::cout << "variance: uniform " << uniform << ", power " << power << ", ratio " << uniform / power
              << "\n";
    EXPECT_GT(uniform, 3.0 * power);
}

// relMSE of three channels of 1,024 pixels is itself known to some 4 %.
TEST_F(ConvergenceTest, ARenderStopsAtTheErrorItWasAskedFor) {
    const Image reference = cornellBoxReference();
    for (const Sampler sampler : {Sampler::independent, Sampler::sobol}) {
        RenderSettings settings = imageSettings(kSide, kSide, 100000);
        settings.estimator.sampler = sampler;
        settings.stop.targetError = 0.004;
        settings.work.waveSize = 16384;
        const Scene scene = loadScene("cornell-box");
        Renderer renderer(device(), scene, scene.cameras.front(), settings);
        EXPECT_EQ(renderer.render([](double) { return true; }), StopReason::targetError);
        const Rendering image = renderer.rendering();
        const double estimate = errorEstimate(image);
        const double error = relMse(image.radiance, reference);
        std::cout << image.sampleCounts.front() << " samples: estimated " << estimate << ", true " << error
                  << "\n";
        EXPECT_LE(estimate, settings.stop.targetError);
        EXPECT_GT(estimate, 0.5 * settings.stop.targetError) << "stopped late";
        EXPECT_LT(error, 1.15 * estimate);
        if (sampler == Sampler::independent) {
            EXPECT_GT(error, 0.85 * estimate);
        }
    }
}

} // namespace
} // namespace lavalight::test
