// Cameras chosen by hand, as values that know no command line.
#include <numbers>

#include <gtest/gtest.h>

#include "base/error.h"
#include "session/builtin.h"
#include "session/camera_choice.h"

namespace lavalight {
namespace {

const Scene& cornellBox() {
    static const Scene scene = loadScene("cornell-box");
    return scene;
}

CameraChoice aimed() {
    CameraChoice choice;
    choice.lookFrom = glm::vec3(0.0f, 0.0f, 4.0f);
    choice.lookAt = glm::vec3(0.0f, 0.0f, 1.0f);
    return choice;
}

TEST(CameraChoice, WithoutAWishTheFirstCameraOfTheSceneIsTaken) {
    const Camera camera = chooseCamera(cornellBox(), {});
    const Camera& first = cornellBox().cameras.front();
    EXPECT_EQ(camera.name, first.name);
    EXPECT_EQ(camera.position, first.position);
    EXPECT_EQ(camera.verticalFov, first.verticalFov);
    EXPECT_TRUE(describe(CameraChoice()).empty());
}

TEST(CameraChoice, AnAimedCameraLooksAtItsPointAndFocusesThere) {
    const Camera camera = chooseCamera(cornellBox(), aimed());
    EXPECT_EQ(camera.position, glm::vec3(0.0f, 0.0f, 4.0f));
    EXPECT_EQ(camera.forward, glm::vec3(0.0f, 0.0f, -1.0f));
    EXPECT_EQ(camera.up, glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_EQ(camera.focusDistance, 3.0f);
}

TEST(CameraChoice, PlacesAreTheWorldsHoweverFarTheSceneIs) {
    Scene scene = cornellBox();
    scene.origin = {1e7, 0.0, -2e7};
    CameraChoice choice = aimed();
    choice.lookFrom = {1e7 + 0.1, 0.0, 4.0 - 2e7};
    choice.lookAt = {1e7 + 0.1, 0.0, 1.0 - 2e7};
    const Camera camera = chooseCamera(scene, choice);
    EXPECT_NEAR(camera.position.x, 0.1f, 1e-8f);
    EXPECT_EQ(camera.position.z, 4.0f);
    EXPECT_EQ(camera.forward, glm::vec3(0.0f, 0.0f, -1.0f));
    EXPECT_EQ(describe(choice).at(0).second, "10000000.1,0,-19999996");
    const ImportOptions import = seenFrom(choice, {.seconds = 2.0});
    EXPECT_EQ(import.viewpoint, choice.lookFrom);
    EXPECT_EQ(import.seconds, 2.0);
}

TEST(CameraChoice, FieldOfViewAndLensAreInDegreesAndDiameters) {
    CameraChoice choice = aimed();
    choice.fov = 90.0f;
    choice.aperture = 0.5f;
    choice.focus = 2.0f;
    const Camera camera = chooseCamera(cornellBox(), choice);
    EXPECT_FLOAT_EQ(camera.verticalFov, static_cast<float>(std::numbers::pi / 2));
    EXPECT_EQ(camera.lensRadius, 0.25f);
    EXPECT_EQ(camera.focusDistance, 2.0f);
}

TEST(CameraChoice, APanoramaIsTwiceAsWideAsHighAndNeedsNoPointToLookAt) {
    CameraChoice choice;
    choice.lookFrom = glm::vec3(1.0f);
    choice.panorama = true;
    const Camera camera = chooseCamera(cornellBox(), choice);
    EXPECT_EQ(camera.projection, Projection::panorama);
    EXPECT_EQ(camera.aspect, 2.0f);
    EXPECT_EQ(camera.position, glm::vec3(1.0f));
}

TEST(CameraChoice, WhatMakesNoSenseIsRefusedByTheOptionsName) {
    const auto refuses = [](const CameraChoice& choice, const char* option) {
        try {
            static_cast<void>(chooseCamera(cornellBox(), choice));
            ADD_FAILURE() << option << ": not refused";
        } catch (const UsageError& error) {
            EXPECT_NE(std::string(error.what()).find(option), std::string::npos) << error.what();
        }
    };
    CameraChoice choice;
    choice.lookFrom = glm::vec3(1.0f);
    refuses(choice, "--look-at");
    choice.lookAt = glm::vec3(1.0f);
    refuses(choice, "--look-at");
    choice = aimed();
    choice.up = glm::vec3(0.0f, 0.0f, 1.0f);
    refuses(choice, "--up");
    choice = aimed();
    choice.name = "0";
    refuses(choice, "--camera");
    for (const float fov : {0.0f, 180.0f, -5.0f, std::numeric_limits<float>::quiet_NaN()}) {
        choice = aimed();
        choice.fov = fov;
        refuses(choice, "--fov");
    }
    const Intrinsics good{{100.0, 100.0}, {50.0, 50.0}};
    for (const Intrinsics& bad :
         {Intrinsics{{0.0, 100.0}, {50.0, 50.0}}, Intrinsics{{100.0, -1.0}, {50.0, 50.0}},
          Intrinsics{{100.0, 100.0}, {2e6, 50.0}}}) {
        choice = aimed();
        choice.intrinsics = bad;
        refuses(choice, "--intrinsics");
    }
    choice = aimed();
    choice.intrinsics = good;
    EXPECT_EQ(chooseCamera(cornellBox(), choice).intrinsics, good);
    choice.fov = 30.0f;
    refuses(choice, "--fov");
    choice = aimed();
    choice.intrinsics = good;
    choice.panorama = true;
    refuses(choice, "--intrinsics");
    choice = {};
    choice.intrinsics = good;
    choice.view = NamedView::front;
    refuses(choice, "--intrinsics");
    for (const glm::vec2& planes : {glm::vec2(2.0f, 1.0f), glm::vec2(-1.0f, 1.0f), glm::vec2(1.0f, 1.0f)}) {
        choice = aimed();
        choice.clip = planes;
        refuses(choice, "--clip");
    }
    choice = aimed();
    choice.clip = glm::vec2(0.5f, 2.0f);
    EXPECT_EQ(chooseCamera(cornellBox(), choice).znear, 0.5f);
    EXPECT_EQ(chooseCamera(cornellBox(), choice).zfar, 2.0f);
    choice.seesAll = true;
    refuses(choice, "--no-clip");
    choice = aimed();
    choice.aperture = -1.0f;
    refuses(choice, "--aperture");
    choice = aimed();
    choice.focus = 0.0f;
    refuses(choice, "--focus");
    choice = {};
    choice.name = "no such camera";
    refuses(choice, "--camera");
}

// Films merge only where these texts are equal.
TEST(CameraChoice, EqualChoicesHaveEqualDescriptionsAndEveryMemberShowsInThem) {
    CameraChoice choice = aimed();
    choice.up = glm::vec3(0.0f, 1.0f, 0.0f);
    choice.fov = 30.0f;
    choice.aperture = 0.25f;
    choice.focus = 1.5f;
    choice.panorama = true;
    const OptionPairs expected{{"look-from", "0,0,4"}, {"look-at", "0,0,1"}, {"up", "0,1,0"},   {"fov", "30"},
                               {"aperture", "0.25"},   {"focus", "1.5"},     {"panorama", "on"}};
    EXPECT_EQ(describe(choice), expected);
    choice = {};
    choice.intrinsics = Intrinsics{{100.0, 90.5}, {50.0, 40.0}};
    choice.clip = glm::vec2(0.5f, 2.0f);
    EXPECT_EQ(describe(choice), (OptionPairs{{"intrinsics", "100,90.5,50,40"}, {"clip", "0.5,2"}}));
}

} // namespace
} // namespace lavalight
