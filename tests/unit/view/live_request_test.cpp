// Which change of what is shown restarts the image.
#include <gtest/gtest.h>

#include "view/live_request.h"

namespace lavalight {
namespace {

LiveRequest makeRequest() {
    LiveRequest request;
    request.scene = std::make_shared<const Scene>();
    return request;
}

template <typename Change>
Restart after(const Change& change) {
    const LiveRequest before = makeRequest();
    LiveRequest now = before;
    change(now);
    return restartsImage(before, now);
}

TEST(RestartsImage, WhatIsOnlyShownOtherwiseDoesNot) {
    EXPECT_EQ(after([](LiveRequest&) {}), Restart::nothing);
    EXPECT_EQ(after([](LiveRequest& r) { r.tone.exposure = 1.0f; }), Restart::nothing);
    EXPECT_EQ(after([](LiveRequest& r) { r.tone.curve = ToneCurve::agx; }), Restart::nothing);
    EXPECT_EQ(after([](LiveRequest& r) { r.other = EstimatorSettings{}; }), Restart::nothing);
    EXPECT_EQ(after([](LiveRequest& r) { r.isSplit = true; }), Restart::nothing);
    EXPECT_EQ(after([](LiveRequest& r) { r.exposesByImage = true; }), Restart::nothing);
    EXPECT_EQ(after([](LiveRequest& r) { r.shown[0] = kDenoisedColor; }), Restart::nothing);
    EXPECT_EQ(after([](LiveRequest& r) { r.tone.backdrop = glm::vec3(1.0f); }), Restart::nothing);
}

TEST(RestartsImage, WhateverChangesTheMeanOrTheNoiseDoes) {
    EXPECT_EQ(after([](LiveRequest& r) { r.camera.position.x = 1.0f; }), Restart::image);
    EXPECT_EQ(after([](LiveRequest& r) { r.settings.image.width = 7; }), Restart::image);
    EXPECT_EQ(after([](LiveRequest& r) { r.settings.estimator.roulette = Roulette::off; }), Restart::image);
    EXPECT_EQ(after([](LiveRequest& r) { r.settings.estimator.seed = 3; }), Restart::image);
    EXPECT_EQ(after([](LiveRequest& r) { r.settings.layers = 1u << kDepthPlane; }), Restart::image);
    EXPECT_EQ(after([](LiveRequest& r) { r.settings.background.kind = Background::transparent; }),
              Restart::image);
    EXPECT_EQ(after([](LiveRequest& r) { r.settings.lighting.rotation = 3.0f; }), Restart::image);
    EXPECT_EQ(after([](LiveRequest& r) { r.isMoving = true; }), Restart::image);
    EXPECT_EQ(after([](LiveRequest& r) { r.settings.work.schedule = Schedule::wavefront; }), Restart::image);
}

TEST(RestartsImage, OtherLightsAndOtherScenesGoToTheDeviceAnew) {
    EXPECT_EQ(after([](LiveRequest& r) { r.scene = std::make_shared<const Scene>(); }), Restart::scene);
    EXPECT_EQ(after([](LiveRequest& r) { r.settings.lighting.intensity = 2.0f; }), Restart::scene);
    EXPECT_EQ(after([](LiveRequest& r) { r.settings.estimator.lightSelection = LightSelection::uniform; }),
              Restart::scene);
    EXPECT_EQ(after([](LiveRequest& r) { r.settings.estimator.mis = Mis::off; }), Restart::scene);
    EXPECT_EQ(after([](LiveRequest& r) { r.settings.estimator.mis = Mis::balance; }), Restart::image);
}

} // namespace
} // namespace lavalight
