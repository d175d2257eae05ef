// Cameras with a lens, with intrinsics, and panoramas, against closed forms.
#include <cmath>

#include <gtest/gtest.h>

#include "support/environment_maps.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kSide = 64;      // pixels
constexpr float kHalfHeight = 0.1f; // half the image's height at distance 1
constexpr float kLensRadius = 0.1f; // metres
constexpr float kRadiance = 1000.0f;
constexpr float kLampDistance = 4.0f; // metres
constexpr float kHalfLamp = 0.02f;    // metres

// Light of a small lamp in the middle of the image, by distance from it.
struct Spot {
    double total = 0.0;
    double within(double radius) const {
        double sum = 0.0;
        for (size_t i = 0; i < light.size(); ++i)
            sum += distances[i] < radius ? light[i] : 0.0;
        return sum;
    }
    std::vector<double> light;
    std::vector<double> distances; // pixels
};

class LensTest : public DeviceTest {
  protected:
    Spot photograph(float focusDistance, float lensRadius) {
        Camera camera = lookAt({0, 0, kLampDistance}, {0, 0, 0}, 2.0f * std::atan(kHalfHeight));
        camera.lensRadius = lensRadius;
        camera.focusDistance = focusDistance;
        const Scene scene =
            SceneBuilder()
                .add(rectangle({0, 0, 0}, {kHalfLamp, 0, 0}, {0, kHalfLamp, 0}), light(glm::vec3(kRadiance)))
                .camera(camera)
                .build();
        RenderSettings settings = imageSettings(kSide, kSide, 1024);
        settings.estimator.maxBounces = 0;
        const Image image = renderScene(device(), scene, settings).rendering.radiance();
        Spot spot;
        for (uint32_t y = 0; y < kSide; ++y)
            for (uint32_t x = 0; x < kSide; ++x) {
                spot.light.push_back(image.at(x, y).r);
                spot.distances.push_back(std::hypot(x + 0.5 - kSide / 2.0, y + 0.5 - kSide / 2.0));
                spot.total += image.at(x, y).r;
            }
        return spot;
    }
};

// By similar triangles: a point at distance d is a circle of radius R |1/f - 1/d| at distance 1.
double circleOfConfusion(float focusDistance) {
    return kLensRadius * std::abs(1.0 / focusDistance - 1.0 / kLampDistance) / kHalfHeight * kSide / 2.0;
}

TEST_F(LensTest, OutOfFocusALampIsADiskAsWideAsTheCircleOfConfusion) {
    const double width = 2.0 * kHalfLamp / kLampDistance / kHalfHeight * kSide / 2.0; // the lamp's, in pixels
    const double total = kRadiance * width * width;
    for (const float focus : {2.0f, 1000.0f}) {
        const Spot spot = photograph(focus, kLensRadius);
        const double radius = circleOfConfusion(focus);
        const double lamp = std::sqrt(2.0) * (0.5 * width + 0.5);
        EXPECT_NEAR(spot.total, total, 0.04 * total) << focus; // no light is lost
        EXPECT_GT(spot.within(radius + lamp), 0.9999 * spot.total) << focus;
        EXPECT_LT(spot.within(radius - lamp), 0.99 * spot.total) << focus;
        EXPECT_NEAR(spot.within(0.5 * radius) / spot.total, 0.25, 0.02) << focus; // evenly over the disk
    }
}

TEST_F(LensTest, InFocusALampIsAsSharpAsThroughAPinhole) {
    const Spot spot = photograph(kLampDistance, kLensRadius);
    EXPECT_EQ(spot.within(3.5), spot.total);
}

class IntrinsicsTest : public DeviceTest {};

// A wall at z = -4: the middle of a pixel sees it where similar triangles say.
TEST_F(IntrinsicsTest, TheMiddleOfEachPixelSeesWhatItsRayMeets) {
    constexpr double kDistance = 4.0;
    constexpr double kTolerance = 2e-5; // metres: 10 roundings of the wall's corners; pixels are 0.1 wide
    const Intrinsics intrinsics{{40.0, 25.0}, {9.0, 21.5}};
    Camera camera = lookAt({0, 0, 0}, {0, 0, -1}, 1.0f);
    camera.intrinsics = intrinsics;
    const Scene scene = SceneBuilder()
                            .add(rectangle({0, 0, -4}, {10, 0, 0}, {0, 10, 0}), lambert(glm::vec3(0.5f)))
                            .camera(camera)
                            .build();
    for (const Schedule schedule : schedulesOf(device())) {
        SCOPED_TRACE(static_cast<int>(schedule));
        RenderSettings settings = imageSettings(24, 16, 3);
        settings.work.schedule = schedule;
        settings.estimator.pixelFilter = PixelFilter::point;
        settings.layers = 1u << kPositionPlane | 1u << kDepthPlane;
        const Rendering image = renderScene(device(), scene, settings).rendering;
        for (uint32_t y = 0; y < 16; ++y)
            for (uint32_t x = 0; x < 24; ++x) {
                const glm::vec3 seen = image.find("position")->mean.at(x, y);
                const glm::dvec2 pixel(x + 0.5, y + 0.5);
                const glm::dvec2 slope = (pixel - intrinsics.center) / intrinsics.focal;
                EXPECT_NEAR(seen.x, kDistance * slope.x, kTolerance) << x << ", " << y;
                EXPECT_NEAR(seen.y, -kDistance * slope.y, kTolerance) << x << ", " << y;
                EXPECT_NEAR(image.find("depth")->mean.at(x, y).x, kDistance, kTolerance);
            }
    }
}

// A wall that comes nearer moves every point away from the axis of the view, by as much as it lies beside it.
TEST_F(IntrinsicsTest, MotionIsMeasuredFromTheAxisOfTheView) {
    Camera camera = lookAt({0, 0, 0}, {0, 0, -1}, 1.0f);
    camera.intrinsics = Intrinsics{{20.0, 30.0}, {5.0, 11.0}};
    Scene scene = SceneBuilder()
                      .add(rectangle({0, 0, -4}, {10, 0, 0}, {0, 10, 0}), lambert(glm::vec3(0.5f)))
                      .camera(camera)
                      .build();
    NextFrame next{{}, camera};
    for (const Mesh& mesh : scene.meshes) {
        next.positions.push_back(mesh.positions);
        for (glm::vec3& position : next.positions.back())
            position.z = -2.0f;
    }
    scene.next = next;
    RenderSettings settings = imageSettings(16, 16, 1);
    settings.estimator.pixelFilter = PixelFilter::point;
    settings.layers = 1u << kMotionPlane;
    const Rendering image = renderScene(device(), scene, settings).rendering;
    for (uint32_t y = 0; y < 16; ++y)
        for (uint32_t x = 0; x < 16; ++x) {
            EXPECT_NEAR(image.find("motion")->mean.at(x, y).x, x + 0.5 - 5.0, 1e-3);
            EXPECT_NEAR(image.find("motion")->mean.at(x, y).y, y + 0.5 - 11.0, 1e-3);
        }
}

class PanoramaTest : public DeviceTest {};

TEST_F(PanoramaTest, OfAnEnvironmentMapIsThatMap) {
    const Image map = randomMap(16, 8, 11);
    Camera camera = lookAt({0, 0, 0}, {1, 0, 0}, 1.0f);
    camera.projection = Projection::panorama;
    Scene scene = SceneBuilder()
                      .add(rectangle({9, 0, 0}, {0, 0, 1e-3f}, {0, 1e-3f, 0}), lambert(glm::vec3(0.0f)))
                      .camera(camera)
                      .build();
    scene.environmentMap = {"test", map};
    const Rendering image = renderScene(device(), scene, imageSettings(16, 8, 1024)).rendering;
    constexpr int kSteps = 32;
    for (uint32_t y = 0; y < 8; ++y)
        for (uint32_t x = 0; x < 16; ++x) {
            glm::dvec3 mean(0.0);
            for (int j = 0; j < kSteps; ++j)
                for (int i = 0; i < kSteps; ++i)
                    mean +=
                        mapLookup(map, {(x + (i + 0.5) / kSteps) / 16.0, (y + (j + 0.5) / kSteps) / 8.0}) /
                        double{kSteps * kSteps};
            const size_t pixel = size_t{y} * 16 + x;
            for (glm::length_t c = 0; c < 3; ++c)
                ASSERT_NEAR(image.radiance().pixels[pixel][c], mean[c],
                            kSigmas * std::sqrt(image.variance().pixels[pixel][c]) + 1e-3)
                    << x << ", " << y;
        }
}

} // namespace
} // namespace lavalight::test
