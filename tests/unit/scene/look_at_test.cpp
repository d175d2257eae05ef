// Cameras placed by hand are those that a file would give.
#include <gtest/gtest.h>

#include "scene/look_at.h"
#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

// Node matrices of glTF: columns right, up, backward, position.
TEST(LookAt, IsTheGltfCameraOfTheSameNodeToTheBit) {
    GltfBuilder gltf;
    gltf.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    gltf.addNode({{"camera", 0}, {"matrix", {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 5, 2, 3, 1}}});
    gltf.addNode({{"mesh", gltf.addTriangle()}});
    gltf.json["scenes"] = {{{"nodes", {0, 1}}}};
    gltf.json["scene"] = 0;
    const Camera expected = gltf.import().cameras.front();
    const auto camera = lookAtCamera({5, 2, 3}, {-1, 2, 3}, {0, 1, 0});
    ASSERT_TRUE(camera);
    EXPECT_EQ(camera->position, expected.position);
    EXPECT_EQ(camera->forward, expected.forward);
    EXPECT_EQ(camera->right, expected.right);
    EXPECT_EQ(camera->up, expected.up);
}

TEST(LookAt, AxesAreOrthonormalAndTheTargetLiesAhead) {
    const auto camera = lookAtCamera({1, 2, 3}, {-4, 0, 7}, {0.1f, 1, 0.3f});
    ASSERT_TRUE(camera);
    for (const glm::vec3& axis : {camera->right, camera->up, camera->forward})
        EXPECT_NEAR(glm::length(axis), 1.0f, 1e-6f);
    EXPECT_LT(glm::length(glm::cross(camera->right, camera->up) + camera->forward), 1e-6f);
    EXPECT_GT(glm::dot(camera->up, glm::vec3(0.1f, 1, 0.3f)), 0.0f);
    EXPECT_LT(glm::length(glm::normalize(glm::vec3(-5, -2, 4)) - camera->forward), 1e-6f);
}

TEST(LookAt, WhatGivesNoDirectionsIsRefused) {
    EXPECT_FALSE(lookAtCamera({1, 2, 3}, {1, 2, 3}, {0, 1, 0}));
    EXPECT_FALSE(lookAtCamera({1, 2, 3}, {1, 9, 3}, {0, 1, 0}));
    EXPECT_FALSE(lookAtCamera({1, 2, 3}, {1, 9, 4}, {0, 0, 0}));
}

} // namespace
} // namespace lavalight::test
