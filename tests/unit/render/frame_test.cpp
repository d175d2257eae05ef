// Image size and camera as the kernels receive them.
#include <cmath>

#include <gtest/gtest.h>

#include "render/renderer.h"
#include "shared/scene.h"

namespace lavalight {
namespace {

Camera tiltedCamera() {
    Camera camera;
    camera.position = {1.0f, 2.0f, 3.0f};
    camera.right = {0.0f, 0.0f, -1.0f};
    camera.up = {0.0f, 1.0f, 0.0f};
    camera.forward = {1.0f, 0.0f, 0.0f};
    camera.verticalFov = 1.0f;
    camera.halfHeight = 2.5f;
    return camera;
}

RenderSettings sized(uint32_t width, uint32_t height) {
    RenderSettings settings;
    settings.image.width = width;
    settings.image.height = height;
    return settings;
}

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_LT(glm::length(a - b), 1e-6f) << a.x << " " << a.y << " " << a.z;
}

TEST(ResolveSize, OpenWidthFollowsTheCamerasAspectRatio) {
    Camera camera;
    camera.aspect = 1.5f;
    EXPECT_EQ(resolveSize(sized(0, 512), camera).image.width, 768u);
    camera.aspect = 0.333f;
    EXPECT_EQ(resolveSize(sized(0, 100), camera).image.width, 33u);
}

TEST(ResolveSize, WithoutAnAspectRatioTheImageIsSixteenToNine) {
    EXPECT_EQ(resolveSize(sized(0, 90), Camera()).image.width, 160u);
}

TEST(ResolveSize, GivenSizeIsKept) {
    Camera camera;
    camera.aspect = 3.0f;
    const RenderSettings settings = resolveSize(sized(20, 30), camera);
    EXPECT_EQ(settings.image.width, 20u);
    EXPECT_EQ(settings.image.height, 30u);
}

TEST(ResolveSize, ExtremeAspectRatiosStayWithinTheLimits) {
    Camera camera;
    camera.aspect = 1e9f;
    EXPECT_EQ(resolveSize(sized(0, 512), camera).image.width, kMaxImageSide);
    camera.aspect = 1e-9f;
    EXPECT_EQ(resolveSize(sized(0, 512), camera).image.width, 1u);
}

TEST(Frame, PerspectiveKeepsTheVerticalFieldOfView) {
    const Camera camera = tiltedCamera();
    const float half = std::tan(0.5f);
    for (const auto& [width, height] : {std::pair{200u, 100u}, std::pair{50u, 100u}}) {
        const FrameParameters frame = makeFrame(Scene(), camera, sized(width, height));
        EXPECT_EQ(frame.projection, kProjectionPerspective);
        EXPECT_EQ(frame.imageWidth, width);
        EXPECT_EQ(frame.imageHeight, height);
        expectNear(frame.cameraUp, half * camera.up);
        expectNear(frame.cameraRight,
                   half * static_cast<float>(width) / static_cast<float>(height) * camera.right);
        expectNear(frame.cameraForward, camera.forward);
        expectNear(frame.cameraPosition, camera.position);
    }
}

TEST(Frame, OrthographicSpansTheCamerasHeight) {
    Camera camera = tiltedCamera();
    camera.projection = Projection::orthographic;
    const FrameParameters frame = makeFrame(Scene(), camera, sized(100, 50));
    EXPECT_EQ(frame.projection, kProjectionOrthographic);
    expectNear(frame.cameraUp, 2.5f * camera.up);
    expectNear(frame.cameraRight, 5.0f * camera.right);
}

TEST(Frame, TheAxisOfAViewMeetsTheMiddleOfTheImage) {
    const FrameParameters frame = makeFrame(Scene(), tiltedCamera(), sized(200, 100));
    EXPECT_EQ(frame.axisX, 1.0f);
    EXPECT_EQ(frame.axisY, 1.0f);
}

TEST(Frame, IntrinsicsInTheMiddleAreAFieldOfView) {
    Camera camera = tiltedCamera();
    const double focal = 50.0 / std::tan(0.5 * camera.verticalFov);
    const FrameParameters expected = makeFrame(Scene(), camera, sized(200, 100));
    camera.verticalFov = 2.0f; // of no account
    camera.framedAspect = 7.0f;
    camera.intrinsics = Intrinsics{{focal, focal}, {100.0, 50.0}};
    const FrameParameters frame = makeFrame(Scene(), camera, sized(200, 100));
    expectNear(frame.cameraRight, expected.cameraRight);
    expectNear(frame.cameraUp, expected.cameraUp);
    EXPECT_EQ(frame.axisX, 1.0f);
    EXPECT_EQ(frame.axisY, 1.0f);
}

// A pixel is 1 / focal length wide at distance 1.
TEST(Frame, IntrinsicsHavePixelsOfTheirOwnShapeAndAnAxisOfTheirOwn) {
    Camera camera = tiltedCamera();
    camera.intrinsics = Intrinsics{{400.0, 250.0}, {50.0, 75.0}};
    const FrameParameters frame = makeFrame(Scene(), camera, sized(200, 100));
    expectNear(frame.cameraRight, 100.0f / 400.0f * camera.right);
    expectNear(frame.cameraUp, 50.0f / 250.0f * camera.up);
    EXPECT_FLOAT_EQ(frame.axisX, 0.5f);
    EXPECT_FLOAT_EQ(frame.axisY, 1.5f);
}

// Before the near plane, and seen only where the view reaches farther to the right than to the left.
TEST(Frame, WhatAnOffCentreViewShowsIsClipped) {
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(
        {"near", 0, {{0.7f, 0, -0.5f}, {0.75f, 0, -0.5f}, {0.7f, 0.05f, -0.5f}}, {}, {{0, 1, 2}}});
    Camera camera;
    camera.znear = 1.0f;
    const auto clipNear = [&](double center) {
        camera.intrinsics = Intrinsics{{5.0, 5.0}, {center, 5.0}}; // 2 at distance 1
        return makeFrame(scene, camera, sized(10, 10)).clipNear;
    };
    EXPECT_EQ(clipNear(5.0), 0.0f);
    EXPECT_EQ(clipNear(2.0), 1.0f);
    EXPECT_EQ(clipNear(8.0), 0.0f);
}

TEST(Frame, SettingsReachTheKernels) {
    RenderSettings settings = sized(8, 8);
    settings.estimator.seed = 11;
    settings.estimator.maxBounces = 12;
    settings.estimator.rouletteStart = 13;
    settings.work.waveSize = 1400;
    const FrameParameters frame = makeFrame(Scene(), Camera(), settings);
    EXPECT_EQ(frame.seed, 11u);
    EXPECT_EQ(frame.maxBounces, 12u);
    EXPECT_EQ(frame.rouletteStart, 13u);
    EXPECT_EQ(frame.waveSize, 1400u);
}

// A triangle before the near plane lies half a pixel outside of the image: wide filters reach it.
TEST(Frame, WhatAPixelFilterReachesBeyondTheImageIsClippedToo) {
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(
        {"near", 0, {{0.55f, 0, -0.5f}, {0.6f, 0, -0.5f}, {0.6f, 0.05f, -0.5f}}, {}, {{0, 1, 2}}});
    Camera camera;
    camera.verticalFov = std::acos(0.0f); // at a distance of 1/2 m the image is 1 m wide
    camera.znear = 1.0f;
    RenderSettings settings = sized(10, 10);
    EXPECT_EQ(makeFrame(scene, camera, settings).clipNear, 0.0f);
    settings.estimator.pixelFilter = PixelFilter::mitchell;
    EXPECT_EQ(makeFrame(scene, camera, settings).clipNear, 1.0f);
}

TEST(Frame, IsToldItsLights) {
    Scene scene;
    scene.environment = {1.0f, 2.0f, 3.0f};
    scene.bounds = {glm::vec3(-1.0f), glm::vec3(1.0f)};
    FrameParameters frame = makeFrame(scene, Camera(), sized(8, 8));
    setLights(frame, collectLights(scene, scene.environment, LightSelection::power));
    expectNear(frame.environment, scene.environment);
    EXPECT_EQ(frame.environmentLight, 0u);
    EXPECT_EQ(frame.lightColumns, 1u);
    setLights(frame, collectLights(scene, glm::vec3(0.0f), LightSelection::power));
    expectNear(frame.environment, glm::vec3(0.0f));
    EXPECT_EQ(frame.environmentLight, kNoLight);
    EXPECT_EQ(frame.lightColumns, 0u);
}

} // namespace
} // namespace lavalight
