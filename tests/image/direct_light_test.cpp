// Direct light from a rectangle, against the form factor known in closed form.
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr glm::dvec3 kRadiance(8.0, 4.0, 2.0);
constexpr glm::dvec3 kAlbedo(0.8, 0.5, 0.3);

// A horizontal rectangle with its sides along x and z; centre and half size are (x, z).
struct Panel {
    glm::dvec2 center;
    glm::dvec2 halfSize;
    double height;
};
constexpr Panel kPanel{{0.25, -0.3}, {0.6, 0.4}, 1.5};  // hangs askew over the origin
constexpr Panel kFarPanel{{2.0, 3.0}, {1.0, 1.5}, 3.0}; // hides nothing of the other, nor the other way round

// Form factor from a differential element to a parallel rectangle that has a corner above it and reaches x
// and y away, in units of its height. Howell, "A Catalog of Radiation Heat Transfer Configuration Factors",
// B-3.
double cornerFactor(double x, double y) {
    const double rx = std::sqrt(1.0 + x * x);
    const double ry = std::sqrt(1.0 + y * y);
    return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2.0 * std::numbers::pi);
}

// Form factor from the origin, facing up, to the panel: four rectangles with a corner above the origin, odd
// in both extents.
double formFactor(const Panel& panel) {
    const glm::dvec2 lower = (panel.center - panel.halfSize) / panel.height;
    const glm::dvec2 upper = (panel.center + panel.halfSize) / panel.height;
    return cornerFactor(upper.x, upper.y) - cornerFactor(lower.x, upper.y) - cornerFactor(upper.x, lower.y) +
           cornerFactor(lower.x, lower.y);
}

// The panel as a mesh that faces down.
Shape shapeOf(const Panel& panel) {
    return rectangle({panel.center.x, panel.height, panel.center.y}, {panel.halfSize.x, 0, 0},
                     {0, 0, panel.halfSize.y});
}

// A floor seen at the origin through a window so small that the irradiance is the same all over it.
SceneBuilder floorSeenAtTheOrigin() {
    SceneBuilder builder;
    builder.add(rectangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), lambert(kAlbedo));
    builder.camera(lookAtOrthographic({2.0f, 1.0f, 0.5f}, {0, 0, 0}, 1e-3f));
    return builder;
}

struct Strategy {
    const char* name;
    bool nee;
    Mis mis;
};

std::ostream& operator<<(std::ostream& out, const Strategy& strategy) {
    return out << strategy.name;
}

class DirectLight : public DeviceTest, public testing::WithParamInterface<Strategy> {
  protected:
    [[nodiscard]] RenderResult renderWith(const Scene& scene, uint32_t maxBounces = 1) {
        RenderSettings settings = imageSettings(16, 16, 512);
        settings.estimator.nextEventEstimation = GetParam().nee;
        settings.estimator.mis = GetParam().mis;
        settings.estimator.maxBounces = maxBounces;
        return renderScene(device(), scene, settings);
    }
};

TEST_P(DirectLight, IrradianceFollowsTheFormFactor) {
    const Scene scene = floorSeenAtTheOrigin().add(shapeOf(kPanel), light(kRadiance)).build();
    expectMean(renderWith(scene), kRadiance * kAlbedo * formFactor(kPanel), 0.01);
}

TEST_P(DirectLight, SingleSidedLightEmitsNothingBehind) {
    const Scene scene = floorSeenAtTheOrigin().add(insideOut(shapeOf(kPanel)), light(kRadiance)).build();
    expectEveryPixel(renderWith(scene), glm::dvec3(0.0));
}

TEST_P(DirectLight, DoubleSidedLightEmitsTheSameBehind) {
    Material lamp = light(kRadiance);
    lamp.doubleSided = true;
    const Scene scene = floorSeenAtTheOrigin().add(insideOut(shapeOf(kPanel)), lamp).build();
    expectMean(renderWith(scene), kRadiance * kAlbedo * formFactor(kPanel), 0.01);
}

TEST_P(DirectLight, BackOfASingleSidedSurfaceCastsAShadow) {
    const Scene scene = floorSeenAtTheOrigin()
                            .add(insideOut(shapeOf(kPanel)), light(kRadiance))
                            .environment(glm::vec3(1.0f))
                            .build();
    expectMean(renderWith(scene), kAlbedo * (1.0 - formFactor(kPanel)), 0.01);
}

TEST_P(DirectLight, LightsAddUp) {
    const glm::dvec3 farRadiance(1.0, 4.0, 9.0);
    const Scene scene = floorSeenAtTheOrigin()
                            .add(shapeOf(kPanel), light(kRadiance))
                            .add(shapeOf(kFarPanel), light(farRadiance))
                            .build();
    const glm::dvec3 irradiance = kRadiance * formFactor(kPanel) + farRadiance * formFactor(kFarPanel);
    expectMean(renderWith(scene), kAlbedo * irradiance, 0.01);
}

TEST_P(DirectLight, NoBounceShowsEmissionAlone) {
    const Scene dark = floorSeenAtTheOrigin().add(shapeOf(kPanel), light(kRadiance)).build();
    expectEveryPixel(renderWith(dark, 0), glm::dvec3(0.0));
    const Scene glow = SceneBuilder()
                           .add(shapeOf(kPanel), light(kRadiance))
                           .camera(lookAtOrthographic({0.3f, 0, 0}, {0.25f, 1.5f, -0.3f}, 0.01f))
                           .build();
    expectEveryPixel(renderWith(glow, 0), kRadiance);
}

INSTANTIATE_TEST_SUITE_P(Strategies, DirectLight,
                         testing::Values(Strategy{"power", true, Mis::power},
                                         Strategy{"balance", true, Mis::balance},
                                         Strategy{"lightSamplesOnly", true, Mis::off},
                                         Strategy{"bsdfSamplesOnly", false, Mis::power}),
                         [](const auto& strategy) { return std::string(strategy.param.name); });

} // namespace
} // namespace lavalight::test
