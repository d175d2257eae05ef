// A Lambert ground below a scene, in every schedule.
#include <vector>

#include <gtest/gtest.h>

#include "scene/ground.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

class GroundImage : public DeviceTest {};

TEST_F(GroundImage, WhiteGroundUnderAWhiteBallInAWhiteFurnaceIsWhite) {
    Scene scene = SceneBuilder()
                      .add(ball({0, 1, 0}, 1.0f), lambert(glm::vec3(1.0f)))
                      .environment(glm::vec3(1.0f))
                      .camera(lookAt({4, 2, 6}, {0, 1, 0}, 0.9f)) // with the horizon
                      .build();
    addGround(scene, groundHeight(scene.bounds), glm::vec3(1.0f));
    for (const Schedule schedule : schedulesOf(device())) {
        RenderSettings settings = imageSettings(32, 32, 64);
        settings.work.schedule = schedule;
        settings.estimator.maxBounces = 256;
        expectMean(renderScene(device(), scene, settings), glm::dvec3(1.0), 0.01);
    }
}

// Light samples that end short of the ground would pass for light from above.
TEST_F(GroundImage, NoLightComesFromBelow) {
    Scene scene = SceneBuilder()
                      .add(ball({0, 1, 0}, 1.0f), lambert(glm::vec3(1.0f)))
                      .camera(lookAt({0, 3, 6}, {0, 1, 0}, 0.6f))
                      .build();
    Image map(4, 512);
    for (uint32_t y = 259; y < 264; ++y) // from 1 to 3 degrees below the horizon
        for (uint32_t x = 0; x < 4; ++x)
            map.pixels[size_t{y} * 4 + x] = glm::vec3(1000.0f);
    scene.environmentMap = {"test", map};
    addGround(scene, groundHeight(scene.bounds), glm::vec3(0.5f));
    for (const Schedule schedule : schedulesOf(device())) {
        RenderSettings settings = imageSettings(32, 32, 64);
        settings.work.schedule = schedule;
        expectEveryPixel(renderScene(device(), scene, settings), glm::dvec3(0.0));
    }
}

// Seen under several angles, so that distances to the two would round in different ways.
TEST_F(GroundImage, FloorOfTheModelHidesIt) {
    Scene scene = SceneBuilder()
                      .add(rectangle({0.3f, 1.1f, 0}, {0, 0, 3}, {3, 0, 0}), lambert(glm::vec3(0.75f)))
                      .environment(glm::vec3(1.0f))
                      .build();
    addGround(scene, groundHeight(scene.bounds), glm::vec3(0.25f));
    for (const Schedule schedule : schedulesOf(device()))
        for (const float distance : {1.0f, 7.0f, 40.0f}) {
            scene.cameras = {lookAtOrthographic({distance, 3.3f, 0.7f}, {0.3f, 1.1f, 0.1f}, 0.04f)};
            RenderSettings settings = imageSettings(32, 32, 16);
            settings.work.schedule = schedule;
            expectEveryPixel(renderScene(device(), scene, settings), glm::dvec3(0.75));
        }
    scene.cameras = {lookAtOrthographic({40, 20, 0}, {30, 1.1f, 0}, 0.5f)};
    expectEveryPixel(renderScene(device(), scene, imageSettings(32, 32, 16)), glm::dvec3(0.25));
}

} // namespace
} // namespace lavalight::test
