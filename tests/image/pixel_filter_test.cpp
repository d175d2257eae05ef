// Pixel filters: an edge shows their profile, and the mean of an image stays, in every schedule.
#include <cmath>

#include <gtest/gtest.h>

#include "render/pixel_filter.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kSide = 12;
constexpr uint32_t kSamples = 256;

class PixelFilterImage : public DeviceTest {
  protected:
    [[nodiscard]] RenderSettings settings(Schedule schedule, PixelFilter filter) const {
        RenderSettings settings = imageSettings(kSide, kSide, kSamples);
        settings.work.schedule = schedule;
        settings.estimator.pixelFilter = filter;
        return settings;
    }
};

// Share of the filter that lies left of a place, in pixels from its middle.
double shareLeftOf(PixelFilter filter, double radius, double place) {
    constexpr int kSteps = 20000;
    double left = 0.0;
    double all = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double x = 2.0 * (i + 0.5) / kSteps - 1.0;
        const double value = filterValue(filter, std::abs(x));
        all += value;
        left += radius * x < place ? value : 0.0;
    }
    return left / all;
}

// The left half of the image emits 1, to a quarter pixel beyond the middle.
TEST_F(PixelFilterImage, AnEdgeShowsTheProfileOfTheFilter) {
    const Scene scene =
        SceneBuilder()
            .add(rectangle({-10 + 0.5f / kSide, 0, 0}, {10, 0, 0}, {0, 10, 0}), light(glm::vec3(1.0f)))
            .camera(lookAtOrthographic({0, 0, 5}, {0, 0, 0}, 1.0f))
            .build();
    // Each schedule has a kernel of its own for camera rays; the filters are tables for them.
    const std::vector<Schedule> schedules = schedulesOf(device());
    for (const Schedule schedule : schedules)
        for (const PixelFilter filter : {PixelFilter::box, PixelFilter::tent, PixelFilter::gaussian,
                                         PixelFilter::blackmanHarris, PixelFilter::mitchell}) {
            if (schedule != schedules.front() && filter != PixelFilter::mitchell)
                continue;
            SCOPED_TRACE(static_cast<int>(schedule) * 10 + static_cast<int>(filter));
            const RenderSettings wanted = settings(schedule, filter);
            const RenderResult result = renderScene(device(), scene, wanted);
            EXPECT_EQ(result.tallies.negativeSamples, 0u);
            for (uint32_t x = 0; x < kSide; ++x) {
                double mean = 0.0;
                double variance = 0.0;
                for (uint32_t y = 0; y < kSide; ++y) {
                    mean += result.rendering.radiance().at(x, y).x / kSide;
                    variance += result.rendering.variance().at(x, y).x / (kSide * kSide);
                }
                const double place = kSide / 2 + 0.25 - (x + 0.5);
                const double expected = shareLeftOf(filter, filterRadius(wanted.estimator), place);
                EXPECT_NEAR(mean, expected, kSigmas * std::sqrt(variance) + 2e-4) << "column " << x;
            }
        }
}

// Indirect light, glass and metal; a mean over the image that the filters' borders hardly touch.
TEST_F(PixelFilterImage, TheMeanOfAnImageStays) {
    const Scene scene = SceneBuilder()
                            .add(ball({0, 0, 0}, 0.6f), lambert({0.7f, 0.4f, 0.2f}))
                            .environment(glm::vec3(1.0f))
                            .camera(lookAt({0, 0.4f, 4}, {0, 0, 0}, 0.8f))
                            .build();
    const Schedule schedule = schedulesOf(device()).front();
    const ImageMean box =
        meanOf(renderScene(device(), scene, settings(schedule, PixelFilter::box)).rendering);
    for (const PixelFilter filter : {PixelFilter::gaussian, PixelFilter::mitchell}) {
        const ImageMean other = meanOf(renderScene(device(), scene, settings(schedule, filter)).rendering);
        for (glm::length_t c = 0; c < 3; ++c)
            EXPECT_NEAR(box.mean[c], other.mean[c],
                        kSigmas * std::hypot(box.standardError[c], other.standardError[c]));
    }
}

// Layers of data weigh 1; coverage is a share, whatever lobes the filter has.
TEST_F(PixelFilterImage, NegativeLobesChangeNoLayerOfDataAndLeaveCoverageAShare) {
    const Scene scene = SceneBuilder()
                            .add(rectangle({-10, 0, 0}, {10, 0, 0}, {0, 10, 0}), lambert(glm::vec3(0.5f)))
                            .environment(glm::vec3(1.0f))
                            .camera(lookAtOrthographic({0, 0, 5}, {0, 0, 0}, 1.0f))
                            .build();
    RenderSettings wanted = settings(schedulesOf(device()).front(), PixelFilter::mitchell);
    wanted.background.kind = Background::transparent;
    wanted.layers = 1u << kAlbedoPlane | 1u << kDepthPlane;
    const Rendering image = renderScene(device(), scene, wanted).rendering;
    float least = 0.0f;
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) {
            const float coverage = image.find("coverage")->mean.at(x, y).x;
            EXPECT_GE(coverage, 0.0f);
            EXPECT_LE(coverage, 1.0f);
            const float albedo = image.find("albedo")->mean.at(x, y).x;
            EXPECT_GE(albedo, 0.0f);
            EXPECT_LE(albedo, 0.5001f);
            if (image.find("hits")->mean.at(x, y).x > 0.0f) {
                EXPECT_NEAR(image.find("depth")->mean.at(x, y).x, 5.0f, 1e-4f);
            }
            least = std::min(least, image.radiance().at(x, y).x);
        }
    EXPECT_LT(least, -0.005f) << "the lobes show nowhere";
}

} // namespace
} // namespace lavalight::test
