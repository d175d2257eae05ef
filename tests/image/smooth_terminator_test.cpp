// Smooth-shaded meshes of few triangles: they are lit as the smooth surface that their normals stand for.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "gltf/import.h"
#include "support/estimator_variants.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
const glm::vec3 kOrigin(0.0f);

// A sphere of `columns` by `rows` faces around the origin, its poles on the y axis.
Shape globe(uint32_t columns, uint32_t rows, float radius = 1.0f) {
    Shape shape;
    for (uint32_t row = 0; row <= rows; ++row)
        for (uint32_t column = 0; column < columns; ++column) {
            const float theta = kPi * static_cast<float>(row) / static_cast<float>(rows);
            const float phi = 2.0f * kPi * static_cast<float>(column) / static_cast<float>(columns);
            shape.positions.push_back(radius * glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                                         -std::sin(theta) * std::sin(phi)));
        }
    for (uint32_t row = 0; row < rows; ++row)
        for (uint32_t column = 0; column < columns; ++column) {
            const uint32_t next = (column + 1) % columns;
            const glm::uvec4 corners(row * columns + column, (row + 1) * columns + column,
                                     (row + 1) * columns + next, row * columns + next);
            if (row + 1 < rows)
                shape.triangles.emplace_back(corners.x, corners.y, corners.z);
            if (row > 0)
                shape.triangles.emplace_back(corners.x, corners.z, corners.w);
        }
    return shape;
}

Scene field(const char* name) {
    return importGltf(std::filesystem::path(LAVALIGHT_SOURCE_DIR) / "tests/field" / name);
}

class SmoothTerminator : public DeviceTest {};

// Whatever a mirror reflects, in a white furnace it is 1.
TEST_F(SmoothTerminator, CoarseMirrorOfTheFieldIsInvisibleInAWhiteFurnace) {
    Scene scene = field("smooth_mirror.glb");
    scene.environment = glm::vec3(1.0f);
    RenderSettings settings = imageSettings(128, 128, 16);
    expectEveryPixel(renderScene(device(), scene, settings), glm::dvec3(1.0));
    settings.estimator.smoothTerminator = false;
    const ImageMean off = meanOf(renderScene(device(), scene, settings).rendering);
    EXPECT_LT(off.mean.g, 0.99) << "without it, the rim is black";
}

// A hollow mirror, too: seen from inside, its smooth surface lies behind the mesh.
TEST_F(SmoothTerminator, CoarseMirrorIsInvisibleFromInsideAsWell) {
    Material mirror = lambert(glm::vec3(1.0f));
    mirror.metallic = 1.0f;
    mirror.roughness = 0.0f;
    mirror.doubleSided = true;
    Shape bowl = globe(12, 6);
    std::erase_if(bowl.triangles, [&](const glm::uvec3& t) {
        return bowl.positions[t.x].y + bowl.positions[t.y].y + bowl.positions[t.z].y > 0.1f;
    });
    const Scene scene = SceneBuilder()
                            .addSmooth(bowl, kOrigin, mirror)
                            .environment(glm::vec3(1.0f))
                            .camera(lookAtOrthographic({0.5f, 3.0f, 1.0f}, kOrigin, 1.2f))
                            .build();
    RenderSettings settings = imageSettings(64, 64, 16);
    settings.estimator.roulette = Roulette::off;
    settings.estimator.maxBounces = 1024;
    expectEveryPixel(renderScene(device(), scene, settings), glm::dvec3(1.0));
}

// All directions above a convex smooth surface are free, and Lambert returns what comes from them.
TEST_F(SmoothTerminator, CoarseWhiteBallIsInvisibleInAWhiteFurnace) {
    for (const auto& [columns, rows] : {std::pair{12u, 6u}, {24u, 12u}, {64u, 32u}}) {
        const Scene scene = SceneBuilder()
                                .addSmooth(globe(columns, rows), kOrigin, lambert(glm::vec3(1.0f)))
                                .environment(glm::vec3(1.0f))
                                .camera(lookAtOrthographic({1.0f, 2.0f, 3.0f}, kOrigin, 1.1f))
                                .build();
        RenderSettings settings = imageSettings(48, 48, 64);
        const Rendering on = renderScene(device(), scene, settings).rendering;
        for (size_t i = 0; i < on.radiance().pixels.size(); ++i)
            EXPECT_NEAR(on.radiance().pixels[i].g, 1.0f, 0.02f) << columns << " columns, pixel " << i;
        EXPECT_NEAR(meanOf(on).mean.g, 1.0, 0.001);
        settings.estimator.smoothTerminator = false;
        EXPECT_LT(meanOf(renderScene(device(), scene, settings).rendering).mean.g, 0.9998);
    }
}

// Largest difference between the radiance of a smooth sphere under a sun, max(0, n.l), and that of the
// field's sphere of 24 x 12 faces, more than `border` within its outline. Its camera frames 2.2 m.
double largestStair(gpu::Device& device, bool smoothTerminator) {
    const Scene scene = field("low_sphere.glb");
    constexpr uint32_t size = 96;
    RenderSettings settings = imageSettings(size, size, 64);
    settings.estimator.smoothTerminator = smoothTerminator;
    const Rendering rendering = renderScene(device, scene, settings).rendering;
    const glm::vec3 light = -scene.punctualLights.at(0).direction;
    double largest = 0.0;
    for (uint32_t y = 0; y < size; ++y)
        for (uint32_t x = 0; x < size; ++x) {
            const glm::vec2 p = 1.1f * (2.0f * (glm::vec2(x, y) + 0.5f) / static_cast<float>(size) - 1.0f);
            const float r2 = glm::dot(p, p);
            if (r2 > 0.95f * 0.95f)
                continue;
            const glm::vec3 n(p.x, -p.y, std::sqrt(1.0f - r2));
            const double expected = std::max(0.0f, glm::dot(n, light));
            largest = std::max(largest, std::abs(rendering.radiance().pixels[y * size + x].g - expected));
        }
    return largest;
}

TEST_F(SmoothTerminator, ShadowOfACoarseSphereFadesWithoutStairs) {
    EXPECT_LT(largestStair(device(), true), 0.05);
    EXPECT_GT(largestStair(device(), false), 0.1);
}

// The mesh still casts its shadows: nothing comes through it, at any angle.
TEST_F(SmoothTerminator, NoLightComesThroughAClosedBody) {
    Material white = lambert(glm::vec3(1.0f));
    white.doubleSided = true;
    const auto seenFrom = [&](const Camera& camera, const std::vector<glm::vec3>& lamps) {
        Scene scene = SceneBuilder().addSmooth(globe(10, 6), kOrigin, white).camera(camera).build();
        for (const glm::vec3& position : lamps) {
            PunctualLight lamp;
            lamp.position = position;
            lamp.intensity = glm::vec3(100.0f);
            scene.punctualLights.push_back(lamp);
        }
        return meanOf(renderScene(device(), scene, imageSettings(64, 64, 64)).rendering).mean.g;
    };
    const Camera inside = lookAt({0.1f, 0.2f, 0.0f}, {1.0f, 0.5f, 0.3f}, 2.0f);
    const Camera outside = lookAt({1.0f, 2.0f, 3.0f}, kOrigin, 0.7f);
    const std::vector<glm::vec3> around = {
        {1.2f, 0, 0}, {0, 1.5f, 0}, {-1, -1, 1}, {0, 0.5f, 3}, {5, -2, -5}};
    EXPECT_EQ(seenFrom(inside, around), 0.0);
    EXPECT_EQ(seenFrom(outside, {{0, 0, 0}, {0.7f, 0.3f, 0.2f}}), 0.0);
    EXPECT_GT(seenFrom(outside, around), 0.1);
}

// A pipe and a ball that pierce the walls of a box, and a ball that stands on its floor: their smooth
// surfaces reach through the walls, and rays from there would see the sky.
TEST_F(SmoothTerminator, NoLightEntersWhereACoarseMeshMeetsAWall) {
    Material white = lambert(glm::vec3(0.8f));
    white.doubleSided = true;
    const Shape coarse = globe(12, 6, 0.5f);
    const auto moved = [&](const glm::vec3& by) {
        Shape shape = coarse;
        for (glm::vec3& p : shape.positions)
            p += by;
        return shape;
    };
    SceneBuilder builder;
    builder.add(insideOut(cube(kOrigin, 2.0f)), white).environment(glm::vec3(1000.0f));
    for (const glm::vec3& place : {glm::vec3(2.0f, 0.3f, -1.0f), {0.0f, -1.5f, 0.0f}, {-1.0f, 2.1f, -1.2f}})
        builder.addSmooth(moved(place), place, white);
    for (const glm::vec3& target :
         {glm::vec3(2.0f, 0.3f, -1.0f), {0.0f, -2.0f, 0.0f}, {-1.0f, 2.1f, -1.2f}}) {
        const Scene scene = builder.camera(lookAt({-0.5f, 0.0f, 1.9f}, target, 0.6f)).build();
        EXPECT_EQ(meanOf(renderScene(device(), scene, imageSettings(96, 96, 64)).rendering).mean.g, 0.0);
    }
}

// One triangle with the normals of the unit sphere, 0.8 m from the sphere's centre: its middle is lifted by
// 0.36 * 0.8 m (Hanika 2021, chapter 4), and a lamp is a metre above that.
TEST_F(SmoothTerminator, LampsAreAsFarAwayAsTheSmoothSurfaceIs) {
    Shape triangle{{}, {{0, 1, 2}}};
    for (int i = 0; i < 3; ++i) {
        const float phi = 2.0f * kPi * static_cast<float>(i) / 3.0f;
        triangle.positions.emplace_back(0.6f * std::cos(phi), 0.6f * std::sin(phi), 0.8f);
    }
    Scene scene = SceneBuilder()
                      .addSmooth(triangle, kOrigin, lambert(glm::vec3(1.0f)))
                      .camera(lookAtOrthographic({0, 0, 5}, kOrigin, 1e-4f))
                      .build();
    PunctualLight lamp;
    lamp.position = {0, 0, 0.8f + 0.36f * 0.8f + 1.0f};
    lamp.intensity = glm::vec3(kPi);
    scene.punctualLights.push_back(lamp);
    const auto seen = [&](bool smoothTerminator) {
        RenderSettings settings = imageSettings(8, 8, 4);
        settings.estimator.smoothTerminator = smoothTerminator;
        return meanOf(renderScene(device(), scene, settings).rendering).mean.g;
    };
    EXPECT_NEAR(seen(true), 1.0, 1e-3);
    EXPECT_NEAR(seen(false), 1.0 / (1.288 * 1.288), 1e-3);
}

// Light that passes starts on the mesh: from above it, the triangle itself would be in its way.
TEST_F(SmoothTerminator, LightPassesCoarseSmoothPanesAndLeaves) {
    Material pane = lambert(glm::vec3(1.0f));
    pane.transmission = 1.0f;
    pane.ior = 1.0f;
    Material leaf = lambert(glm::vec3(1.0f));
    leaf.diffuseTransmission = 1.0f;
    leaf.doubleSided = true;
    const auto seen = [&](const Material& material) {
        const Scene scene = SceneBuilder()
                                .addSmooth(globe(12, 6), kOrigin, material)
                                .environment(glm::vec3(1.0f))
                                .camera(lookAtOrthographic({1.0f, 2.0f, 3.0f}, kOrigin, 1.1f))
                                .build();
        RenderSettings settings = imageSettings(32, 32, 16);
        settings.estimator.roulette = Roulette::off;
        return renderScene(device(), scene, settings);
    };
    expectEveryPixel(seen(pane), glm::dvec3(1.0));
    EXPECT_GT(meanOf(seen(leaf).rendering).mean.g, 0.9);
}

// Rays from the boundary of a solid start on the mesh, and so do those of metal, which lets nothing in.
TEST_F(SmoothTerminator, MetalThatBoundsASolidIsLitWhereTheMeshIs) {
    Material metal = lambert(glm::vec3(1.0f));
    metal.metallic = 1.0f;
    metal.roughness = 0.7f;
    metal.transmission = 1.0f;
    metal.isSolid = true;
    metal.attenuationColor = glm::vec3(0.5f);
    metal.attenuationDistance = 1.0f;
    Scene scene = SceneBuilder()
                      .addSmooth(globe(12, 6), kOrigin, metal)
                      .camera(lookAtOrthographic({1.0f, 2.0f, 3.0f}, kOrigin, 0.3f))
                      .build();
    ASSERT_EQ(scene.solids.size(), 1u);
    PunctualLight lamp;
    lamp.position = {0.4f, 0.8f, 1.2f};
    lamp.intensity = glm::vec3(1.0f);
    scene.punctualLights.push_back(lamp);
    RenderSettings settings = imageSettings(16, 16, 4);
    const RenderResult on = renderScene(device(), scene, settings);
    settings.estimator.smoothTerminator = false;
    EXPECT_EQ(on.filmWords, renderScene(device(), scene, settings).filmWords);
    EXPECT_GT(meanOf(on.rendering).mean.g, 0.1);
}

// The normals of a smooth ball out of sight are none of a slanting plane without.
TEST_F(SmoothTerminator, FlatMeshesBesideSmoothOnesKeepTheirPlanes) {
    for (const glm::vec3& n : {glm::vec3(0.6f, 0.0f, 0.8f), {-0.6f, 0.8f, 0.0f}, {0.0f, -0.8f, -0.6f}}) {
        const glm::vec3 u = glm::normalize(glm::cross(n, glm::vec3(0.3f, 0.5f, 0.7f)));
        Scene scene = SceneBuilder()
                          .add(rectangle(kOrigin, u, glm::cross(n, u)), lambert(glm::vec3(1.0f)))
                          .addSmooth(globe(12, 6), kOrigin, lambert(glm::vec3(0.0f)))
                          .camera(lookAtOrthographic(5.0f * n, kOrigin, 0.5f))
                          .build();
        for (glm::vec3& p : scene.meshes[1].positions)
            p -= 30.0f * n;
        PunctualLight sun;
        sun.kind = PunctualKind::directional;
        sun.direction = -n;
        sun.intensity = glm::vec3(kPi);
        scene.punctualLights.push_back(sun);
        expectEveryPixel(renderScene(device(), scene, imageSettings(8, 8, 4)), glm::dvec3(1.0));
    }
}

// Packed normals round, which lifts nothing.
TEST_F(SmoothTerminator, PlanesWithNormalsKeepTheirBits) {
    for (const glm::vec3& direction : {glm::vec3(0.31f, 0.52f, 0.79f),
                                       {-0.9f, 0.2f, 0.3f},
                                       {0.17f, -0.71f, 0.41f},
                                       {0.51f, 0.47f, -0.61f}}) {
        const glm::vec3 n = glm::normalize(direction);
        const glm::vec3 u = glm::normalize(glm::cross(n, glm::vec3(0.3f, -0.5f, 0.7f)));
        const glm::vec3 v = glm::cross(n, u);
        Scene scene = SceneBuilder()
                          .add(rectangle(kOrigin, u, v), lambert(glm::vec3(0.8f)))
                          .add(rectangle(0.3f * n + 2.0f * u, n, v), light(glm::vec3(5.0f)))
                          .camera(lookAtOrthographic(5.0f * n - 2.0f * u, kOrigin, 0.6f))
                          .build();
        scene.meshes[0].normals.assign(4, n);
        RenderSettings settings = imageSettings(16, 16, 8);
        const RenderResult on = renderScene(device(), scene, settings);
        settings.estimator.smoothTerminator = false;
        EXPECT_EQ(on.filmWords, renderScene(device(), scene, settings).filmWords);
        EXPECT_GT(meanOf(on.rendering).mean.g, 0.0);
    }
}

TEST_F(SmoothTerminator, FlatMeshesKeepTheirBits) {
    const Scene scene = SceneBuilder()
                            .add(globe(12, 6), lambert(glm::vec3(0.8f)))
                            .add(rectangle({0, 3, 0}, {1, 0, 0}, {0, 0, 1}), light(glm::vec3(5.0f)))
                            .environment(glm::vec3(0.2f))
                            .camera(lookAt({1, 2, 4}, kOrigin, 0.8f))
                            .build();
    RenderSettings settings = imageSettings(32, 32, 8);
    const RenderResult on = renderScene(device(), scene, settings);
    settings.estimator.smoothTerminator = false;
    EXPECT_EQ(on.filmWords, renderScene(device(), scene, settings).filmWords);
}

// Coarse smooth bodies of several materials, which shade each other and themselves, under a lamp, a sky, and
// lights in a tree.
Scene coarseScene() {
    Material plastic = lambert({0.7f, 0.3f, 0.2f});
    plastic.specular = 1.0f;
    plastic.roughness = 0.4f;
    Material metal = lambert({0.9f, 0.8f, 0.6f});
    metal.metallic = 1.0f;
    metal.roughness = 0.35f;
    Material leaf = lambert({0.3f, 0.7f, 0.1f});
    leaf.diffuseTransmission = 0.5f;
    leaf.diffuseTransmissionColor = {0.9f, 0.8f, 0.2f};
    SceneBuilder builder;
    const auto addGlobe = [&](const glm::vec3& center, float radius, const Material& material) {
        Shape shape = globe(10, 6, radius);
        for (glm::vec3& position : shape.positions)
            position += center;
        builder.addSmooth(shape, center, material);
    };
    addGlobe({-1.0f, 0.8f, 0.0f}, 0.8f, lambert(glm::vec3(0.8f)));
    addGlobe({0.7f, 0.6f, 0.4f}, 0.6f, plastic);
    addGlobe({0.3f, 1.7f, -0.6f}, 0.6f, metal);
    addGlobe({1.7f, 1.3f, -0.3f}, 0.5f, leaf);
    builder.add(rectangle({0, 0, 0}, {0, 0, 4}, {4, 0, 0}), lambert({0.6f, 0.5f, 0.4f}));
    builder.add(rectangle({-2, 3, 1}, {0.6f, 0, 0}, {0, 0, 0.6f}), light({6, 6, 7}));
    builder.add(rectangle({2.5f, 1, 1.5f}, {0, 0, 0.6f}, {0, 0.6f, 0}), light({5, 3, 2}));
    return builder.environment({0.2f, 0.25f, 0.3f}).camera(lookAt({0.5f, 2, 6}, {0, 0.9f, 0}, 0.6f)).build();
}

TEST_F(SmoothTerminator, EverySettingHasTheMeanOfTheDefaultOnCoarseBodies) {
    expectOneMean(device(), coarseScene(), variantsOfDirections(), {384, 0.4});
}

// A lamp that lies in the planes of many triangles, seen from beside: rays that started elsewhere, or went by
// other sides, would differ here by tenths.
TEST_F(SmoothTerminator, LightsAreFoundAlikeBySamplingAndByHittingWhereTheShadowBegins) {
    const Scene scene = SceneBuilder()
                            .addSmooth(globe(12, 6), kOrigin, lambert(glm::vec3(0.8f)))
                            .add(rectangle({3, 0, 0}, {0, 0, 1}, {0, 1, 0}), light(glm::vec3(8.0f)))
                            .camera(lookAtOrthographic({-0.8f, 0.3f, 4.0f}, {0.0f, 0.0f, 0.0f}, 0.6f))
                            .build();
    std::vector<Variant> variants = singleVariants();
    std::erase_if(variants,
                  [](const Variant& v) { return v.settings.roulette != EstimatorSettings{}.roulette; });
    expectOneMean(device(), scene, variants, {512, 0.4});
}

} // namespace
} // namespace lavalight::test
