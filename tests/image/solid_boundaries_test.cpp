// Boundaries of solids: what lies on either side of them, where they coincide, and where camera rays start
// among them.
#include <cstdint>

#include <gtest/gtest.h>

#include "render/setting_names.h"
#include "session/ledger.h"
#include "support/media_scenes.h"

namespace lavalight::test {
namespace {

class SolidBoundaries : public MediaTest {
  protected:
    // Each channel's mean within `tolerance`, relative: for scenes far away, whose coordinates are coarse.
    void expectNear(const Scene& scene, const glm::dvec3& expected, double tolerance) {
        const ImageMean mean = meanOf(render(scene).rendering);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(mean.mean[c] / expected[c], 1.0, tolerance) << "channel " << c;
    }
};

// Distances are those between surfaces, wherever rays start.
TEST_F(SolidBoundaries, OfThinPanesFarFromTheOriginHaveTwoSides) {
    const float far[][2] = {
        {1000.0f, 0.001f}, {1000.0f, 0.0039f}, {4096.0f, 0.004f}, {100.0f, 0.001f}, {10000.0f, 0.016f}};
    for (const auto& [height, thickness] : far) {
        const float top = height + thickness;
        Material material = glassOf(1.0f);
        material.attenuationColor = kMetreColor;
        material.attenuationDistance = top - height; // what single precision makes of it
        const Scene scene = SceneBuilder()
                                .add(box({-2, -2, height}, {2, 2, top}), material)
                                .environment(glm::vec3(1.0f))
                                .camera(down(height + 5.0f))
                                .build();
        SCOPED_TRACE(testing::Message() << thickness << " m at " << height << " m");
        expectNear(scene, over(1.0), 3e-3); // heights are multiples of a sixteenth of the thickness
        Material clear = glassOf(1.5f);     // a pane without absorption bends rays twice, too
        Scene glass = SceneBuilder()
                          .add(box({-2, -2, height}, {2, 2, top}), clear)
                          .add(squareAt(height - 100.0f, 9.0f), unlit(glm::vec3(1.0f)))
                          .camera(down(height + 5.0f))
                          .build();
        const double r = 0.04;
        expectNear(glass, glm::dvec3((1.0 - r) / (1.0 + r)), 0.03);
    }
}

// Rays bend nowhere inside (KHR_materials_volume asks for both indices of a boundary).
TEST_F(SolidBoundaries, OfABodyOfTheSameIndexWithinAnotherAreInvisible) {
    const auto scene = [](bool hasBall) {
        SceneBuilder builder;
        builder.add(cube({0, 0, 0}, 1.0f), glassOf(1.5f));
        if (hasBall)
            builder.add(ball({0.1f, 0, 0}, 0.5f), glassOf(1.5f));
        builder.add(rectangle({0, -1.5f, 0}, {0, 0, 4}, {4, 0, 0}), unlit({0.2f, 0.5f, 0.8f}));
        return builder.environment({0.9f, 0.6f, 0.3f}).camera(lookAt({2, 1.5f, 3}, {0, 0, 0}, 0.6f)).build();
    };
    const Scene nested = scene(true);
    ASSERT_EQ(nested.solids.size(), 2u);
    const RenderResult with = render(nested, 64, 32);
    const RenderResult without = render(scene(false), 64, 32);
    expectSameMean(with.rendering, without.rendering, 4);
    const auto& a = with.rendering.radiance().pixels;
    const auto& b = without.rendering.radiance().pixels;
    double difference = 0.0;
    for (size_t i = 0; i < a.size(); ++i)
        difference += glm::length(glm::dvec3(a[i]) - glm::dvec3(b[i])) / static_cast<double>(a.size());
    EXPECT_LT(difference, 0.02);
}

// A boundary that the medium around it hides counts no bounce.
TEST_F(SolidBoundaries, ThatAreHiddenAreNoVertices) {
    const Scene scene =
        SceneBuilder()
            .add(box({-1, -1, -1}, {1, 1, 1}), glassOf(1.0f, kMetreColor))
            .add(box({-3, -3, -0.5f}, {3, 3, 0.5f}), glassOf(1.9f)) // within the first it is not seen
            .environment(glm::vec3(1.0f))
            .camera(down(3.0f))
            .build();
    RenderSettings settings = imageSettings(8, 8, 4);
    settings.estimator.maxBounces = 2; // into the first and out
    settings.estimator.roulette = Roulette::off;
    const RenderResult result = renderScene(device(), scene, settings);
    EXPECT_EQ(result.tallies.cutPaths, 0u);
    expectEveryPixel(result, over(2.0));
}

// Shadow rays stop at a hidden boundary, so that only paths find what is behind it.
TEST_F(SolidBoundaries, ThatAreHiddenLeaveLightBehindThemWhole) {
    const auto lit = [](bool hasHidden) {
        SceneBuilder builder;
        builder.add(box({-2, -2, -2}, {2, 2, 2}), glassOf(1.0f, kMetreColor));
        builder.add(squareAt(-1.0f, 1.5f), lambert(glm::vec3(0.8f)));
        builder.add(insideOut(squareAt(1.0f, 0.7f)), light(glm::vec3(3.0f)));
        if (hasHidden)
            builder.add(box({-5, -5, -0.2f}, {5, 5, 5}), glassOf(1.7f));
        return builder.camera(down(0.5f)).build();
    };
    const RenderResult plain = render(lit(false), 256);
    const RenderResult hidden = render(lit(true), 1024);
    expectSameMean(hidden.rendering, plain.rendering, 4);
    EXPECT_LT(glm::length(meanOf(hidden.rendering).standardError / meanOf(hidden.rendering).mean), 0.02);
}

// A liquid that touches its glass has no film of air between them, which would leave 0.888 of the light.
TEST_F(SolidBoundaries, ThatCoincideAreOneInterface) {
    const double reflected[] = {1.0 - passing(1.0, 1.5), 1.0 - passing(1.5, 1.33), 1.0 - passing(1.33, 1.0)};
    double sum = 0.0;
    for (const double r : reflected)
        sum += r / (1.0 - r);
    const double expected = 1.0 / (1.0 + sum); // a stack of plates with all reflections between them
    for (const bool isTurned : {false, true})
        for (const glm::vec3& offset : {glm::vec3(0.0f), glm::vec3(300.0f, -200.0f, 100.0f)}) {
            SCOPED_TRACE(testing::Message() << (isTurned ? "turned" : "straight") << ", at " << offset.x);
            const auto place = [&](const Shape& shape) {
                return moved(isTurned ? turned(shape) : shape, offset);
            };
            Camera camera = down(3.0f);
            if (isTurned)
                for (glm::vec3* v : {&camera.position, &camera.right, &camera.up, &camera.forward})
                    *v = turned(*v);
            camera.position += offset;
            Shape liquid = box({-2, -2, -1}, {2, 2, 0});
            for (glm::uvec3& t : liquid.triangles)
                t = {t.y, t.z, t.x};
            const Scene scene = SceneBuilder()
                                    .add(place(box({-2, -2, 0}, {2, 2, 1})), glassOf(1.5f))
                                    .add(place(liquid), glassOf(1.33f))
                                    .add(place(squareAt(-2)), unlit(glm::vec3(1.0f)))
                                    .camera(camera)
                                    .build();
            expectMean(render(scene, 256), glm::dvec3(expected), 0.002);
        }
}

TEST_F(SolidBoundaries, TheListAtTheCameraFollowsWhereEachRayStarts) {
    // Half of the view, and half of a lens, is in the box; a near plane is in it as a whole. The floor shows
    // what each ray takes itself to be in.
    const Shape floor = squareAt(-3.0f, 9.0f);
    Camera wide = down(0.5f);
    wide.position = {0, 0, 0.5f};
    wide.halfHeight = 1.0f;
    for (const bool isLeft : {true, false}) {
        const Shape half = isLeft ? box({-5, -5, -1}, {0, 5, 1}) : box({0, -5, -1}, {5, 5, 1});
        const Scene scene = SceneBuilder()
                                .add(half, glassOf(1.0f, kMetreColor))
                                .add(floor, unlit(glm::vec3(1.0f)))
                                .camera(wide)
                                .build();
        for (const Schedule schedule : schedulesOf(device())) {
            const Rendering image = render(scene, 4, 16, schedule).rendering;
            for (uint32_t x = 0; x < 16; ++x)
                for (uint32_t y = 0; y < 16; ++y)
                    EXPECT_NEAR(image.radiance().pixels[y * 16 + x].g, (x < 8) == isLeft ? over(1.5).g : 1.0,
                                1e-5)
                        << (isLeft ? "left: " : "right: ") << x << ", " << y;
        }
    }
    Camera cut = down(3.0f);
    cut.znear = 2.5f;
    const Scene clipped = SceneBuilder()
                              .add(box({-2, -2, -1}, {2, 2, 1}), glassOf(1.0f, kMetreColor))
                              .environment(glm::vec3(1.0f))
                              .camera(cut)
                              .build();
    expectEverywhere(clipped, over(1.5));
    Camera lens = lookAt({0, 0, 0}, {0, 0, -1}, 0.01f);
    lens.lensRadius = 0.5f;
    lens.focusDistance = 10.0f;
    const Scene blurred = SceneBuilder()
                              .add(box({-5, -5, -1}, {0, 5, 1}), glassOf(1.0f, {0.0f, 0.0f, 0.0f}))
                              .add(floor, unlit(glm::vec3(1.0f)))
                              .camera(lens)
                              .build();
    expectMean(render(blurred, 256), glm::dvec3(0.5), 0.01); // half of the lens is in ink
}

TEST_F(SolidBoundaries, OfMoreSolidsThanAListHoldsAreCountedAndNamed) {
    SceneBuilder builder;
    for (int i = 1; i <= 6; ++i)
        builder.add(cube({0, 0, 0}, 0.2f * static_cast<float>(i)), glassOf(1.0f, glm::vec3(0.9f)));
    const Scene scene = builder.environment(glm::vec3(1.0f)).camera(down(3.0f)).build();
    const RenderResult fused = render(scene);
    for (const Schedule schedule : schedulesOf(device()))
        EXPECT_EQ(render(scene, 4, 16, schedule).tallies.crowdedPaths, 16u * 16u * 4u) << nameOf(schedule);
    EXPECT_NE(crowdedText(scene, fused.tallies).find("\"mesh 5\""), std::string::npos)
        << crowdedText(scene, fused.tallies);
    const RenderResult wavefront = render(scene, 4, 16, Schedule::wavefront);
    EXPECT_EQ(wavefront.tallies.crowdedPaths, fused.tallies.crowdedPaths);
    EXPECT_EQ(wavefront.filmWords, fused.filmWords);
}

} // namespace
} // namespace lavalight::test
