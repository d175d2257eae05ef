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
    builder.json["cameras"] = Json::array({kPerspective});
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
    builder.json["cameras"] = Json::array({kPerspective});
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
    builder.json["cameras"] = Json::array({kPerspective});
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

// A bent row of points: no box fits it closely.
Scene hook() {
    Scene scene;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {3, 0.1f, 0}, {3, 2, 0.5f}, {2.5f, 2, -1}, {0.2f, 0.3f, 0.7f}};
    scene.bounds = {{0, 0, -1}, {3, 2, 0.7f}};
    scene.meshes.push_back(mesh);
    return scene;
}

struct Seen { // of the image, whose sides are at -1 and 1
    glm::vec2 least{1e9f};
    glm::vec2 most{-1e9f};
};

Seen seenBy(const Camera& camera, const Scene& scene, float aspect) {
    Seen seen;
    for (const glm::vec3& position : scene.meshes[0].positions) {
        EXPECT_GT(glm::dot(position - camera.position, camera.forward), 0.0f);
        const glm::vec2 at = project(camera, position) / glm::vec2(aspect, 1.0f);
        seen.least = glm::min(seen.least, at);
        seen.most = glm::max(seen.most, at);
    }
    return seen;
}

TEST(ViewCamera, ReachesTheMarginOnBothSidesOfOneAxisAndIsInTheMiddleOfTheOther) {
    constexpr float kMargin = 1.0f / 1.1f;
    constexpr float kNear = 1e-3f;
    const Scene scene = hook();
    for (const NamedView view : {NamedView::front, NamedView::back, NamedView::left, NamedView::right,
                                 NamedView::top, NamedView::bottom, NamedView::threeQuarter})
        for (const float aspect : {0.4f, 1.0f, 3.0f}) {
            SCOPED_TRACE(static_cast<int>(view));
            const Camera camera = viewCamera(scene, view, {.aspect = aspect, .verticalFov = 0.6f});
            expectOrthonormal(camera);
            const Seen seen = seenBy(camera, scene, aspect);
            EXPECT_NEAR(std::max(seen.most.x, seen.most.y), kMargin, kNear);
            EXPECT_GT(std::min(seen.least.x, seen.least.y), -kMargin - kNear);
            const bool fillsWidth = seen.most.x > seen.most.y;
            EXPECT_NEAR(fillsWidth ? seen.least.x : seen.least.y, -kMargin, kNear);
        }
    expectNear(viewCamera(scene, NamedView::left, {}).forward, {1, 0, 0});
    expectNear(viewCamera(scene, NamedView::top, {}).up, {0, 0, -1});
}

TEST(ViewCamera, TurnsKeepEveryVertexInTheImageAtOneDistanceFromTheMiddle) {
    const Scene scene = hook();
    for (const float aspect : {0.5f, 3.0f}) { // limited by the width, and by the height
        float closest = 0.0f;                 // to the borders
        const auto turned = [&](float turns) {
            return turnedCamera(scene, NamedView::threeQuarter, turns,
                                {.aspect = aspect, .verticalFov = 1.2f});
        };
        const float distance = glm::length(turned(0.0f).position - scene.bounds.center());
        for (int i = 0; i < 720; ++i) {
            const Camera camera = turned(static_cast<float>(i) / 720.0f);
            EXPECT_NEAR(glm::length(camera.position - scene.bounds.center()), distance, 1e-4f * distance);
            const Seen seen = seenBy(camera, scene, aspect);
            closest = std::max({closest, seen.most.x, seen.most.y, -seen.least.x, -seen.least.y});
        }
        EXPECT_NEAR(closest, 1.0f / 1.1f, 1e-3f) << aspect;
    }
    // A quarter counter-clockwise as seen from above: from +z towards +x.
    EXPECT_GT(turnedCamera(scene, NamedView::front, 0.25f, {}).position.x, 5.0f);
}

TEST(ViewCamera, FramesAnEmptySceneAndASinglePoint) {
    Scene scene;
    EXPECT_TRUE(std::isfinite(viewCamera(scene, NamedView::front, {}).position.z));
    scene.meshes.emplace_back().positions = {{1, 2, 3}};
    scene.bounds = {{1, 2, 3}, {1, 2, 3}};
    EXPECT_GT(viewCamera(scene, NamedView::front, {}).position.z, 3.0f);
    EXPECT_GT(turnedCamera(scene, NamedView::front, 0.0f, {}).position.z, 3.0f);
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
