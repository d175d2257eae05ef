// Tests of cameras from files and of the camera that frames a scene.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "scene/framing_camera.h"
#include "unit/gltf/builder.h"

namespace lavalight::test {
namespace {

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_NEAR(glm::length(a - b), 0.0f, 1e-6f) << a.x << " " << a.y << " " << a.z;
}

void expectOrthonormal(const Camera& camera) {
    EXPECT_NEAR(glm::length(camera.right), 1.0f, 1e-6f);
    EXPECT_NEAR(glm::length(camera.up), 1.0f, 1e-6f);
    expectNear(glm::cross(camera.right, camera.up), -camera.forward);
}

const Json kPerspective = {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}};

TEST(GltfCamera, PerspectiveLooksAlongMinusZOfItsNode) {
    GltfBuilder builder;
    builder.json["cameras"] = {kPerspective};
    builder.json["cameras"][0]["perspective"]["aspectRatio"] = 1.5;
    const float half = std::sqrt(0.5f);
    builder.addNode({{"camera", 0},
                     {"name", "eye"},
                     {"translation", {1, 2, 3}},
                     {"rotation", {0, half, 0, half}}}); // 90 degrees about y: -z becomes -x
    const Scene scene = builder.import();
    ASSERT_EQ(scene.cameras.size(), 1u);
    const Camera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "eye");
    EXPECT_EQ(camera.projection, Projection::perspective);
    EXPECT_FLOAT_EQ(camera.verticalFov, 0.7f);
    EXPECT_FLOAT_EQ(camera.aspect.value(), 1.5f);
    expectNear(camera.position, {1, 2, 3});
    expectNear(camera.forward, {-1, 0, 0});
    expectNear(camera.up, {0, 1, 0});
    expectOrthonormal(camera);
}

TEST(GltfCamera, OrthographicKeepsItsHalfHeight) {
    GltfBuilder builder;
    builder.json["cameras"] = {
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"zfar", 9}, {"znear", 0}}}}};
    builder.addNode({{"camera", 0}});
    const Camera camera = builder.import().cameras.at(0);
    EXPECT_EQ(camera.projection, Projection::orthographic);
    EXPECT_EQ(camera.halfHeight, 2.0f);
    EXPECT_FLOAT_EQ(camera.aspect.value(), 1.5f);
}

TEST(GltfCamera, ScalesShearsAndMirrorsOfTheNodeDoNotReachTheCamera) {
    GltfBuilder builder;
    builder.json["cameras"] = {kPerspective};
    builder.addNode({{"scale", {-3, 2, 5}}, {"children", {1}}});
    builder.addNode({{"camera", 0}, {"rotation", {0.3, 0.2, 0.1, 0.9}}});
    expectOrthonormal(builder.import().cameras.at(0));
}

TEST(GltfCamera, CamerasComeInTheOrderOfTheFile) {
    GltfBuilder builder;
    builder.json["cameras"] = {kPerspective, kPerspective};
    builder.addNode({{"camera", 1}, {"name", "second"}});
    builder.addNode({{"camera", 0}, {"name", "first"}});
    const Scene scene = builder.import();
    EXPECT_EQ(scene.cameras.at(0).name, "first");
    EXPECT_EQ(scene.cameras.at(1).name, "second");
}

TEST(GltfCamera, CameraThatCannotFormAnImageIsLeftOutWithAWarning) {
    GltfBuilder builder;
    builder.json["cameras"] = {kPerspective};
    builder.json["cameras"][0]["perspective"]["yfov"] = 0;
    builder.addNode({{"camera", 0}, {"name", "blind"}});
    const Scene scene = builder.import();
    EXPECT_EQ(scene.cameras.size(), 1u); // the framing one
    EXPECT_EQ(warningsWith(scene, "camera 0 \"blind\""), 1);
}

// Where a point lands in the image: -1 .. 1 from bottom to top, in units of half the height in both
// directions.
glm::vec2 project(const Camera& camera, const glm::vec3& point) {
    const glm::vec3 offset = point - camera.position;
    const float depth = glm::dot(offset, camera.forward) * std::tan(0.5f * camera.verticalFov);
    return glm::vec2(glm::dot(offset, camera.right), glm::dot(offset, camera.up)) / depth;
}

TEST(FramingCamera, ShowsAllCornersOfAnyBoxAndFillsTheImage) {
    for (const Bounds& bounds : {Bounds{{-1, -1, -1}, {1, 1, 1}}, Bounds{{0, 0, 0}, {100, 1, 1}},
                                 Bounds{{5, 5, 5}, {5, 9, 5}}, Bounds{{1e-4f, 0, 0}, {2e-4f, 1e-4f, 0}}}) {
        const Camera camera = framingCamera(bounds);
        expectOrthonormal(camera);
        float farthest = 0.0f;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 point((corner & 1) != 0 ? bounds.upper.x : bounds.lower.x,
                                  (corner & 2) != 0 ? bounds.upper.y : bounds.lower.y,
                                  (corner & 4) != 0 ? bounds.upper.z : bounds.lower.z);
            const glm::vec2 seen = glm::abs(project(camera, point));
            farthest = std::max({farthest, seen.x, seen.y});
        }
        EXPECT_LT(farthest, 1.0f);
        EXPECT_GT(farthest, 0.8f);
    }
}

TEST(FramingCamera, EmptySceneStillHasAUsableCamera) {
    const Scene scene = GltfBuilder().import();
    ASSERT_EQ(scene.cameras.size(), 1u);
    expectOrthonormal(scene.cameras[0]);
    EXPECT_GT(glm::length(scene.cameras[0].position), 0.5f);
    EXPECT_EQ(warningsWith(scene, "no triangles"), 1);
}

} // namespace
} // namespace lavalight::test
