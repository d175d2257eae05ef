// Moving the camera by hand.
#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "scene/look_at.h"
#include "view/camera_rig.h"
#include "view/view_state.h"

namespace lavalight {
namespace {

constexpr float kNear = 1e-4f;

using Option = OptionPairs::value_type;

const Bounds kScene{{-1.0f, -1.0f, -1.0f}, {1.0f, 1.0f, 1.0f}};

CameraRig makeRig() {
    return {*lookAtCamera({0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}), kScene};
}

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_LT(glm::length(a - b), kNear)
        << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

void expectOrthonormal(const Camera& camera) {
    expectNear(glm::cross(camera.right, camera.up), -camera.forward);
    EXPECT_NEAR(glm::length(camera.right), 1.0f, kNear);
    EXPECT_NEAR(glm::length(camera.up), 1.0f, kNear);
}

// Where the pivot appears.
glm::vec2 pivotOnImage(const CameraRig& rig) {
    return *project(rig.camera(), 1.0f, rig.pivot());
}

TEST(CameraRig, OrbitsAboutTheMiddleOfTheSceneAndKeepsItsDistance) {
    CameraRig rig = makeRig();
    expectNear(rig.pivot(), glm::vec3(0.0f));
    rig.orbit({0.5f * std::numbers::pi_v<float>, 0.0f});
    expectNear(rig.camera().position, {-5.0f, 0.0f, 0.0f});
    rig.orbit({0.3f, 0.4f});
    EXPECT_NEAR(rig.distance(), 5.0f, kNear);
    EXPECT_LT(glm::length(pivotOnImage(rig) - 0.5f), kNear);
    expectOrthonormal(rig.camera());
}

TEST(CameraRig, NeverTurnsOverThePoles) {
    CameraRig rig = makeRig();
    for (int i = 0; i < 100; ++i)
        rig.orbit({0.1f, 0.2f});
    EXPECT_GT(rig.camera().up.y, 0.0f);
    EXPECT_GT(rig.camera().forward.y, 0.99f);
    for (int i = 0; i < 100; ++i)
        rig.orbit({0.0f, -0.2f});
    EXPECT_GT(rig.camera().up.y, 0.0f);
    EXPECT_LT(rig.camera().forward.y, -0.99f);
    expectOrthonormal(rig.camera());
}

TEST(CameraRig, PansAsFarAsTheMouseMoves) {
    CameraRig rig = makeRig();
    const glm::vec3 before = rig.pivot();
    rig.pan({0.25f, 0.1f}, 1.0f);
    const glm::vec2 there = *project(rig.camera(), 1.0f, before);
    EXPECT_NEAR(there.x, 0.75f, kNear);
    EXPECT_NEAR(there.y, 0.6f, kNear);
    EXPECT_LT(glm::length(pivotOnImage(rig) - 0.5f), kNear);
}

TEST(CameraRig, DolliesTowardsThePivotAndFliesPastIt) {
    CameraRig rig = makeRig();
    rig.dolly(0.5f);
    expectNear(rig.camera().position, {0.0f, 0.0f, 2.5f});
    rig.fly({0.0f, 0.0f, 10.0f});
    expectNear(rig.camera().position, {0.0f, 0.0f, -7.5f});
    EXPECT_NEAR(rig.distance(), 2.5f, kNear);
}

TEST(CameraRig, LooksAroundWithoutMoving) {
    CameraRig rig = makeRig();
    rig.look({0.2f, 0.1f});
    expectNear(rig.camera().position, {0.0f, 0.0f, 5.0f});
    EXPECT_GT(rig.camera().forward.x, 0.0f);
    EXPECT_GT(rig.camera().forward.y, 0.0f);
    EXPECT_NEAR(rig.distance(), 5.0f, kNear);
    EXPECT_LT(glm::length(pivotOnImage(rig) - 0.5f), kNear);
}

TEST(CameraRig, CentresAndFocusesOnAPoint) {
    CameraRig rig = makeRig();
    const glm::vec3 point(1.0f, 0.5f, 0.0f);
    rig.focusOn(point);
    EXPECT_NEAR(rig.camera().focusDistance, 5.0f, kNear);
    rig.centreOn(point);
    expectNear(rig.pivot(), point);
    EXPECT_LT(glm::length(pivotOnImage(rig) - 0.5f), kNear);
    expectNear(rig.camera().position, {0.0f, 0.0f, 5.0f});
}

TEST(CameraRig, AnOrthographicViewIsNarrowedInsteadOfMoved) {
    Camera camera = *lookAtCamera({0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
    camera.projection = Projection::orthographic;
    camera.halfHeight = 2.0f;
    CameraRig rig(camera, kScene);
    rig.dolly(0.5f);
    EXPECT_EQ(rig.camera().halfHeight, 1.0f);
    EXPECT_EQ(rig.camera().position, camera.position);
    rig.pan({0.5f, 0.0f}, 1.0f);
    expectNear(rig.camera().position, {-1.0f, 0.0f, 5.0f});
}

TEST(CameraRig, ItsOptionsAreInTheWorldWithAllDigits) {
    CameraRig rig = makeRig();
    rig.fly({0.1f, 0.0f, 0.0f});
    EXPECT_EQ(cameraOptions(rig, 1.0f, glm::dvec3(0.0)).at(0), Option("look-from", "0.1,0,5"));
    const OptionPairs far = cameraOptions(rig, 1.0f, {1e7, 0.0, -2e7});
    EXPECT_EQ(far.at(0), Option("look-from", "10000000.100000001,0,-19999995"));
    EXPECT_EQ(far.at(1), Option("look-at", "10000000.100000001,0,-20000000"));
    EXPECT_EQ(far.at(2), Option("up", "0,1,0"));
}

TEST(CameraRig, StaysWhereItIsInTheWorldWhenTheOriginMoves) {
    CameraRig rig = makeRig();
    const OptionPairs before = cameraOptions(rig, 1.0f, {1e7, 0.0, 0.0});
    rig.moveOrigin({-8.0, 2.0, 0.5});
    expectNear(rig.pivot(), {8.0f, -2.0f, -0.5f});
    EXPECT_EQ(cameraOptions(rig, 1.0f, {1e7 - 8.0, 2.0, 0.5}), before);
}

// A moment of an animation whose scene has another origin.
TEST(MoveOrigin, TakesTheSceneCameraFromTheSceneWhichHasItInFull) {
    Scene before;
    before.cameras = {makeRig().camera()};
    before.cameras[0].position.x = 1e7f;
    auto after = std::make_shared<Scene>(before);
    after->origin = {1e7, 0.0, 0.0};
    after->cameras[0].position.x = 0.25f;
    const Camera& home = before.cameras[0];
    ViewState atHome{"s.glb", {}, after, CameraRig(home, kScene), home, {}, {}, {}};
    ViewState moved = atHome;
    moved.rig.fly({0.0f, 2.0f, 0.0f});
    moveOrigin(atHome, before);
    expectNear(atHome.home.position, {0.25f, 0.0f, 5.0f});
    expectNear(atHome.rig.camera().position, {0.25f, 0.0f, 5.0f});
    moveOrigin(moved, before);
    expectNear(moved.home.position, {0.25f, 0.0f, 5.0f});
    expectNear(moved.rig.camera().position, {0.0f, 2.0f, 5.0f});
}

TEST(Project, PointsBehindTheCameraDoNotAppear) {
    const Camera camera = makeRig().camera();
    EXPECT_FALSE(project(camera, 1.0f, {0.0f, 0.0f, 6.0f}));
    EXPECT_TRUE(project(camera, 1.0f, {0.0f, 0.0f, 4.0f}));
}

TEST(Project, APanoramaHasTheWorldsAxes) {
    Camera camera = makeRig().camera();
    camera.projection = Projection::panorama;
    const glm::vec3 from = camera.position;
    EXPECT_LT(glm::length(*project(camera, 2.0f, from + glm::vec3(1.0f, 0.0f, 0.0f)) - glm::vec2(0.5f, 0.5f)),
              kNear);
    EXPECT_LT(
        glm::length(*project(camera, 2.0f, from + glm::vec3(0.0f, 0.0f, 1.0f)) - glm::vec2(0.75f, 0.5f)),
        kNear);
    EXPECT_NEAR(project(camera, 2.0f, from + glm::vec3(0.0f, 1.0f, 0.0f))->y, 0.0f, kNear);
}

} // namespace
} // namespace lavalight
