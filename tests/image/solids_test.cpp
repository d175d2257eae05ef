// Solids that overlap are noticed by the paths that cross them, and no others.
#include <array>
#include <cmath>
#include <initializer_list>
#include <vector>

#include <gtest/gtest.h>

#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

Material glassOf(float ior, float roughness = 0.0f) {
    Material glass = lambert(glm::vec3(1.0f));
    glass.transmission = 1.0f;
    glass.isSolid = true;
    glass.roughness = roughness;
    glass.ior = ior;
    return glass;
}

// One mesh of several.
Shape joined(std::initializer_list<Shape> shapes) {
    Shape all;
    for (const Shape& shape : shapes) {
        const auto first = static_cast<uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), shape.positions.begin(), shape.positions.end());
        for (const glm::uvec3& triangle : shape.triangles)
            all.triangles.push_back(triangle + first);
    }
    return all;
}

// About the y axis, so that boxes around solids overlap where these do not: else nothing would be looked for.
Shape turned(Shape shape) {
    const float c = std::cos(0.6f);
    const float s = std::sin(0.6f);
    for (glm::vec3& p : shape.positions)
        p = {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
    return shape;
}

class Solids : public DeviceTest {
  protected:
    // What paths say of the solids, 32 x 32 x 16 paths. The solids stand on a white floor under a white sky,
    // so that paths come from everywhere.
    FilmTallies talliesOf(const std::vector<Shape>& shapes, const Material& material = glassOf(1.5f),
                          const glm::vec3& eye = {3.0f, 2.5f, 5.0f}, Schedule schedule = Schedule::fused) {
        SceneBuilder builder;
        builder.add(rectangle({0, -1.5f, 0}, {0, 0, 6}, {6, 0, 0}), lambert(glm::vec3(0.8f)));
        for (const Shape& shape : shapes)
            builder.add(shape, material);
        const Scene scene = builder.environment(glm::vec3(1.0f)).camera(lookAt(eye, {0, 0, 0}, 0.7f)).build();
        RenderSettings settings = imageSettings(32, 32, 16);
        settings.estimator.maxBounces = 16;
        settings.work.schedule = schedule;
        return renderScene(device(), scene, settings).tallies;
    }

    uint64_t overlaps(const std::vector<Shape>& shapes, const Material& material = glassOf(1.5f),
                      const glm::vec3& eye = {3.0f, 2.5f, 5.0f}) {
        return talliesOf(shapes, material, eye).overlaps;
    }
};

const Shape kLeft = cube({-0.5f, 0, 0}, 0.7f);
const Shape kRight = cube({0.4f, 0.1f, 0.2f}, 0.6f); // reaches into it

TEST_F(Solids, ThatOverlapAreNoticed) {
    const FilmTallies tallies = talliesOf({kLeft, kRight});
    EXPECT_GT(tallies.overlaps, 100u);
    EXPECT_EQ(tallies.overlapping, (std::array<uint32_t, 2>{3, 2}))
        << "the greatest pair, in the order of entering";
    EXPECT_GT(overlaps({kLeft, kRight}, glassOf(1.2f, 0.4f)), 100u) << "rough";
    EXPECT_GT(overlaps({cube({0, 0, 0}, 1.0f), ball({0, 0, 0}, 0.5f)}), 100u) << "one within the other";
    Material wax = lambert(glm::vec3(1.0f));
    wax.diffuseTransmission = 0.8f;
    wax.isSolid = true;
    EXPECT_GT(overlaps({kLeft, kRight}, wax), 10u) << "diffuse";
}

TEST_F(Solids, BothWaysToRenderCountAlike) {
    const FilmTallies fused = talliesOf({kLeft, kRight});
    const FilmTallies wavefront =
        talliesOf({kLeft, kRight}, glassOf(1.5f), {3.0f, 2.5f, 5.0f}, Schedule::wavefront);
    EXPECT_EQ(wavefront.overlaps, fused.overlaps);
    EXPECT_EQ(wavefront.overlapping, fused.overlapping);
}

TEST_F(Solids, ThatAreApartAreNot) {
    EXPECT_EQ(overlaps({kLeft}), 0u);
    EXPECT_EQ(overlaps({ball({0, 0, 0}, 1.0f)}, glassOf(1.5f, 0.3f)), 0u);
    EXPECT_EQ(overlaps({turned(cube({-0.61f, 0, 0}, 0.6f)), turned(cube({0.61f, 0, 0}, 0.6f))}), 0u);
    const Shape shell = joined({cube({0, 0, 0}, 1.0f), insideOut(cube({0, 0, 0}, 0.8f))});
    EXPECT_EQ(overlaps({shell, ball({0, 0, 0}, 0.6f)}), 0u) << "one within a hollow of the other";
}

TEST_F(Solids, ThatTouchAreNot) {
    EXPECT_EQ(overlaps({turned(cube({-0.5f, 0, 0}, 0.5f)), turned(cube({0.5f, 0, 0}, 0.5f))}), 0u);
    const float third = 0.33333333f; // three in a row, whose faces coincide up to rounding
    const float start = 0.1f - 2.0f * third;
    EXPECT_EQ(
        overlaps({turned(cube({start, 0, 0}, third)), turned(cube({start + 2.0f * third, 0.1f, 0}, third)),
                  turned(cube({start + 4.0f * third, 0, 0.1f}, third))}),
        0u);
}

TEST_F(Solids, ThatHoldTheCameraAreNot) {
    const Shape shell = joined({cube({0, 0, 0}, 1.0f), insideOut(cube({0, 0, 0}, 0.5f))});
    EXPECT_EQ(overlaps({shell, ball({0, 0, 0}, 0.4f)}, glassOf(1.5f), {0.7f, 0.3f, 0.6f}), 0u);
}

TEST_F(Solids, ThinWallsHaveNoInside) {
    Material pane = glassOf(1.5f);
    pane.isSolid = false;
    EXPECT_EQ(overlaps({kLeft, kRight}, pane), 0u);
}

} // namespace
} // namespace lavalight::test
