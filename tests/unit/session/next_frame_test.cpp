// Where meshes and the camera are in the next frame.
#include <gtest/gtest.h>

#include "session/next_frame.h"

namespace lavalight {
namespace {

Mesh triangleAt(const std::string& name, const glm::vec3& place) {
    Mesh mesh{name, 0, {place, place + glm::vec3(1, 0, 0), place + glm::vec3(0, 1, 0)}, {}, {{0, 1, 2}}};
    return mesh;
}

TEST(NextFrame, PlacesCountFromTheOriginOfTheSceneAndNotOfTheNext) {
    Scene scene;
    scene.origin = {100.0, 0.0, 0.0};
    scene.meshes = {triangleAt("a", {0, 0, 0})};
    Scene next = scene;
    next.origin = {90.0, 0.0, 5.0};
    next.meshes = {triangleAt("a", {12, 0, 0})}; // in the world at 102, 0, 5
    Camera camera;
    camera.position = {10.0f, 1.0f, 0.0f}; // in the world at 100, 1, 5
    const NextFrame frame = nextFrameOf(scene, next, camera);
    EXPECT_EQ(frame.positions.at(0).at(0), glm::vec3(2, 0, 5));
    EXPECT_EQ(frame.camera.position, glm::vec3(0, 1, 5));
    EXPECT_TRUE(scene.warnings.empty());
}

// A mesh that shrinks to nothing leaves the scene, and others of its name stay apart by their order.
TEST(NextFrame, MeshesAreFoundByTheirNamesAndOthersStandStill) {
    Scene scene;
    scene.meshes = {triangleAt("gone", {5, 0, 0}), triangleAt("a", {0, 0, 0}), triangleAt("a", {1, 0, 0})};
    Scene next;
    next.meshes = {triangleAt("a", {0, 2, 0}), triangleAt("a", {1, 2, 0})};
    const NextFrame frame = nextFrameOf(scene, next, Camera());
    ASSERT_EQ(frame.positions.size(), 3u);
    EXPECT_EQ(frame.positions[0][0], glm::vec3(5, 0, 0));
    EXPECT_EQ(frame.positions[1][0], glm::vec3(0, 2, 0));
    EXPECT_EQ(frame.positions[2][0], glm::vec3(1, 2, 0));
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].find("shows 1 meshes as still"), std::string::npos) << scene.warnings[0];
}

} // namespace
} // namespace lavalight
