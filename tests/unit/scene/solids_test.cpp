// Which meshes bound a body.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "scene/solids.h"
#include "scene/starting_solids.h"
#include "support/scene_builder.h"

namespace lavalight::test {
namespace {

Material glass(float ior = 1.5f) {
    Material material;
    material.transmission = 1.0f;
    material.isSolid = true;
    material.ior = ior;
    return material;
}

Scene sceneOf(const std::vector<Shape>& shapes, const Material& material = glass()) {
    SceneBuilder builder;
    for (const Shape& shape : shapes)
        builder.add(shape, material);
    return builder.build();
}

// The triangles of a shape from `first` to `last`, which is not among them.
Shape part(Shape shape, size_t first, size_t last) {
    shape.triangles = {shape.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                       shape.triangles.begin() + static_cast<std::ptrdiff_t>(last)};
    return shape;
}

TEST(FindSolids, AClosedSurfaceOfSeparateFacesIsABody) {
    const Scene scene = sceneOf({cube({0, 0, 0}, 1.0f), ball({3, 0, 0}, 0.5f)});
    EXPECT_EQ(scene.openSolids, std::vector<std::string>());
    ASSERT_EQ(scene.solids.size(), 2u);
    EXPECT_EQ(scene.solids[0].mesh, 1u) << "the smaller first";
    EXPECT_EQ(scene.meshes[0].solid, 2u);
    EXPECT_EQ(scene.solids[1].bounds.upper, glm::vec3(1.0f));
}

TEST(FindSolids, ThinWallsAndOpaqueBodiesAreNone) {
    Material pane = glass();
    pane.isSolid = false;
    Material stone = glass();
    stone.transmission = 0.0f;
    for (const Material& material : {pane, stone}) {
        const Scene scene = sceneOf({cube({0, 0, 0}, 1.0f)}, material);
        EXPECT_TRUE(scene.solids.empty());
        EXPECT_TRUE(scene.openSolids.empty());
    }
}

TEST(FindSolids, OpenSurfacesAreNamed) {
    const Scene scene = sceneOf({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                 part(cube({0, 0, 0}, 1.0f), 0, 11), cube({5, 0, 0}, 1.0f)});
    EXPECT_EQ(scene.openSolids, (std::vector<std::string>{"mesh 0", "mesh 1"}));
    ASSERT_EQ(scene.solids.size(), 1u);
    EXPECT_EQ(scene.meshes[0].solid, 0u);
    EXPECT_EQ(scene.meshes[2].solid, 1u);
}

TEST(FindSolids, SurfacesThatAreInsideOutBoundNoBody) {
    const Scene scene = sceneOf({insideOut(cube({100, 0, 0}, 1.0f))});
    EXPECT_TRUE(scene.solids.empty());
    EXPECT_EQ(scene.openSolids, std::vector<std::string>{"mesh 0"});
}

TEST(FindSolids, AHollowBelongsToItsBody) {
    Shape shell = cube({0, 0, 0}, 1.0f);
    const Shape hollow = insideOut(cube({0, 0, 0}, 0.5f));
    const auto first = static_cast<uint32_t>(shell.positions.size());
    shell.positions.insert(shell.positions.end(), hollow.positions.begin(), hollow.positions.end());
    for (const glm::uvec3& t : hollow.triangles)
        shell.triangles.push_back(t + first);
    const Scene scene = sceneOf({shell});
    EXPECT_EQ(scene.solids.size(), 1u);
    EXPECT_EQ(solidsAround(scene, {0.7, 0, 0}).numbers, std::vector<uint32_t>{1});
    EXPECT_EQ(solidsAround(scene, {0.2, 0, 0}).numbers, std::vector<uint32_t>());
    EXPECT_TRUE(solidsAround(scene, {0.5, 0.4, 0}).isOnSurface);
    EXPECT_FALSE(solidsAround(scene, {0.5, 0.8, 0}).isOnSurface) << "in the plane of a face, beside it";
}

TEST(FindSolids, MeshesOfOneMediumThatAreClosedTogetherAreOneBody) {
    const Shape whole = cube({0, 0, 0}, 1.0f);
    const Scene scene = sceneOf({part(whole, 0, 5), part(whole, 5, 12), cube({5, 0, 0}, 2.0f)});
    EXPECT_TRUE(scene.openSolids.empty());
    ASSERT_EQ(scene.solids.size(), 2u);
    EXPECT_EQ(scene.meshes[0].solid, 1u);
    EXPECT_EQ(scene.meshes[1].solid, 1u);
    EXPECT_EQ(scene.meshes[2].solid, 2u);
    const Scene mixed =
        SceneBuilder().add(part(whole, 0, 5), glass(1.5f)).add(part(whole, 5, 12), glass(1.33f)).build();
    EXPECT_EQ(mixed.openSolids.size(), 2u) << "what would it be filled with?";
}

TEST(FindSolids, VerticesThatDifferByRoundingAreOne) {
    Shape shape = cube({0, 0, 0}, 1.0f);
    for (size_t i = 0; i < shape.positions.size(); ++i)
        shape.positions[i] *= 1.0f + 1e-7f * static_cast<float>(i % 3);
    EXPECT_TRUE(sceneOf({shape}).openSolids.empty());
    shape.positions[0] *= 1.001f;
    EXPECT_EQ(sceneOf({shape}).openSolids.size(), 1u);
}

TEST(FindSolids, AlphaMakesNoBoundary) {
    Material faded = glass();
    faded.alphaMode = AlphaMode::blend;
    faded.alpha = 0.5f;
    EXPECT_EQ(sceneOf({cube({0, 0, 0}, 1.0f)}, faded).openSolids.size(), 1u);
    faded.alpha = 1.0f;
    EXPECT_EQ(sceneOf({cube({0, 0, 0}, 1.0f)}, faded).solids.size(), 1u);
}

TEST(SolidsAround, CountsHowOftenASurfaceGoesAroundAPoint) {
    const Scene scene = sceneOf({cube({0, 0, 0}, 1.0f), ball({0.5f, 0, 0}, 1.0f), cube({9, 0, 0}, 3.0f)});
    ASSERT_EQ(scene.solids.size(), 3u);
    EXPECT_EQ(solidsAround(scene, {0.5, 0.1, 0.1}).numbers, (std::vector<uint32_t>{1, 2}));
    EXPECT_EQ(solidsAround(scene, {-0.9, 0, 0}).numbers, std::vector<uint32_t>{scene.meshes[0].solid});
    EXPECT_EQ(solidsAround(scene, {9, 0, 0}).numbers, std::vector<uint32_t>{3});
    EXPECT_TRUE(solidsAround(scene, {0, 0, 7}).numbers.empty());
    EXPECT_FALSE(solidsAround(scene, {9, 0, 0}).isOnSurface);
    EXPECT_TRUE(solidsAround(scene, {12, 0.1, 0.2}).isOnSurface);
    EXPECT_TRUE(solidsAround(scene, {12 - 1e-5, 0.1, 0.2}).isOnSurface) << "as near as rounding";
    EXPECT_FALSE(solidsAround(scene, {12 - 1e-3, 0.1, 0.2}).isOnSurface);
}

// What is around the starts of an orthographic view of 2 m, whose middle is at x.
StartingSolids startingAt(const Scene& scene, float x) {
    Camera camera = lookAtOrthographic({x, 0, 0}, {x, 0, -1}, 1.0f);
    return startingSolids(scene, camera, viewExtent(camera, 1.0f, 1.0f), 0.0f);
}

TEST(StartingSolids, VaryWhereABoundaryCrossesThePlaceThatRaysStartIn) {
    const Scene scene = sceneOf({cube({0, 0, 0}, 3.0f)});
    EXPECT_FALSE(startingAt(scene, 1.9f).vary);
    EXPECT_EQ(startingAt(scene, 1.9f).around, std::vector<uint32_t>{1});
    EXPECT_TRUE(startingAt(scene, 2.1f).vary);
    EXPECT_TRUE(startingAt(scene, 3.9f).vary);
    EXPECT_FALSE(startingAt(scene, 4.1f).vary);
    EXPECT_TRUE(startingAt(scene, 4.1f).around.empty());
    const Camera pinhole = lookAt({3, 0, 0}, {3, 0, -1}, 1.0f);
    EXPECT_FALSE(startingSolids(scene, pinhole, viewExtent(pinhole, 1.0f, 1.0f), 0.0f).vary);
}

TEST(StartingSolids, AreThoseOfAPlaceThatIsOnNoSurface) {
    const Scene scene = sceneOf({cube({0, 0, 0}, 3.0f)});
    const StartingSolids starting = startingAt(scene, 3.0f);
    EXPECT_FALSE(solidsAround(scene, starting.reference).isOnSurface);
    EXPECT_EQ(starting.around, solidsAround(scene, starting.reference).numbers);
    EXPECT_LT(std::abs(starting.reference.x - 3.0f), 1.0f);
    EXPECT_LT(std::abs(starting.reference.y), 1.0f);
}

} // namespace
} // namespace lavalight::test
