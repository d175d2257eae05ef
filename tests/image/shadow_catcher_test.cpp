// The ground that catches shadows, in every schedule: shadows with a closed form, and what they leave alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/closed_meshes.h"
#include "support/environment_maps.h"
#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr uint32_t kSide = 8;
constexpr uint32_t kSamples = 1024;
constexpr double kStandardError = 0.5 / kSide / 32.0; // of a share, at most
constexpr float kHeight = 2.0f;                       // of the ball's middle above the ground
constexpr glm::vec3 kBlue(0.1f, 0.2f, 1.0f);
constexpr glm::vec3 kSky(0.5f);

// A sphere but for 1/1000 of its outline.
Shape roundBall(const glm::vec3& center, float radius) {
    const ClosedMesh sphere = makeIcosphere(4);
    Shape shape{{}, sphere.triangles};
    for (const glm::vec3& p : sphere.positions)
        shape.positions.push_back(center + radius * p);
    return shape;
}

// Sees one place of the ground, from beside the ball.
Camera at(float x) {
    return lookAtOrthographic({x + 4.0f, 2.0f, 0.01f}, {x, 0, 0}, 1e-3f);
}

SceneBuilder withBall(float radius, float x) {
    return SceneBuilder().add(roundBall({0, kHeight, 0}, radius), lambert(glm::vec3(0.5f))).camera(at(x));
}

PunctualLight pointLight(const glm::vec3& position, float intensity) {
    PunctualLight light;
    light.position = position;
    light.intensity = glm::vec3(intensity);
    return light;
}

double sineOfBall(double radius, double x) {
    return radius / std::hypot(x, double{kHeight});
}

// The share that a ball covers of the irradiance of a disc overhead, which is seen under `angle` radians to
// its rim, by quadrature.
double shadowOfBall(double radius, double x, double angle) {
    const double cosBall = std::sqrt(1.0 - std::pow(sineOfBall(radius, x), 2.0));
    const glm::dvec2 toBall = glm::dvec2(-x, kHeight) / std::hypot(x, double{kHeight});
    constexpr int kSteps = 1000;
    double blocked = 0.0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) { // evenly by projected solid angle
            const double sine = std::sin(angle) * std::sqrt((i + 0.5) / kSteps);
            const double across = sine * std::cos(kPi * (j + 0.5) / kSteps);
            const double up = std::sqrt(1.0 - sine * sine);
            blocked += across * toBall.x + up * toBall.y > cosBall ? 1.0 : 0.0;
        }
    return blocked / (double{kSteps} * kSteps);
}

class ShadowCatcher : public DeviceTest {
  protected:
    [[nodiscard]] static RenderSettings settings(Schedule schedule, Background background, Ground ground) {
        RenderSettings settings = imageSettings(kSide, kSide, kSamples);
        settings.work.schedule = schedule;
        settings.background = {background, kBlue};
        settings.ground.kind = ground;
        return settings;
    }
    [[nodiscard]] Rendering shadow(const Scene& scene, Schedule schedule,
                                   Background background = Background::transparent) {
        const RenderResult result =
            renderScene(device(), scene, settings(schedule, background, Ground::shadow));
        EXPECT_EQ(result.tallies.droppedSamples, 0u);
        return result.rendering;
    }
    [[nodiscard]] double meanAlpha(const Scene& scene, Schedule schedule) {
        const Rendering image = shadow(scene, schedule);
        double sum = 0.0;
        for (const glm::vec3& pixel : image.find("coverage")->mean.pixels)
            sum += pixel.x;
        for (const glm::vec3& pixel : image.radiance().pixels)
            EXPECT_EQ(pixel, glm::vec3(0.0f));
        return sum / (kSide * kSide);
    }
};

// A ball in the middle of the disc hides the ratio of two projected solid angles, sin^2 / sin^2.
TEST_F(ShadowCatcher, ShadowOfASphereIsWhatItHidesOfTheSunsDisc) {
    constexpr double kSun = 0.2; // radians
    EXPECT_NEAR(shadowOfBall(0.25, 0.0, kSun), std::pow(0.125 / std::sin(kSun), 2.0), 1e-3);
    for (const Schedule schedule : schedulesOf(device()))
        for (const float radius : {0.25f, 0.6f})
            for (const float x : {0.0f, 0.3f, 0.5f, 0.7f, 1.4f}) {
                Scene scene = withBall(radius, x).build();
                scene.environmentMap = {"test", constantMap(8, 4, glm::vec3(1e-4f))};
                scene.environmentMap->sun = {
                    {0, 1, 0}, {100, 50, 20}, static_cast<float>(1.0 - std::cos(kSun))};
                EXPECT_NEAR(meanAlpha(scene, schedule), shadowOfBall(radius, x, kSun),
                            kSigmas * kStandardError + 1e-3)
                    << radius << " at " << x << ", " << static_cast<int>(schedule);
            }
}

// A lamp of many triangles near the ball, among which light is picked.
TEST_F(ShadowCatcher, ShadowOfASphereIsWhatItHidesOfARoundLamp) {
    constexpr float kAbove = 4.0f;
    constexpr float kRadius = 1.5f;
    constexpr uint32_t kCorners = 64;
    const auto area = static_cast<float>(0.5 * kCorners * std::sin(2.0 * kPi / kCorners) / kPi);
    Shape lamp{{{0, kAbove, 0}}, {}};
    for (uint32_t i = 0; i < kCorners; ++i) {
        const double phi = 2.0 * kPi * i / kCorners;
        const glm::vec3 corner(std::cos(phi), 0.0, std::sin(phi));
        lamp.positions.push_back(glm::vec3(0, kAbove, 0) + kRadius / std::sqrt(area) * corner);
        lamp.triangles.emplace_back(0, 1 + i, 1 + (i + 1) % kCorners); // seen from below
    }
    const double sine2 = kRadius * kRadius / (kRadius * kRadius + kAbove * kAbove);
    for (const Schedule schedule : schedulesOf(device()))
        for (const float radius : {0.3f, 0.6f}) {
            const Scene scene = withBall(radius, 0.0f).add(lamp, light({5, 4, 3})).build();
            EXPECT_NEAR(meanAlpha(scene, schedule), std::pow(sineOfBall(radius, 0.0), 2.0) / sine2,
                        kSigmas * kStandardError + 1e-3)
                << radius << ", " << static_cast<int>(schedule);
        }
}

// The cone of a point light 4 m above the ground through a ball half way up meets the ground 1.0328 m out.
TEST_F(ShadowCatcher, ShadowOfAPointLightIsAllOrNothing) {
    for (const Schedule schedule : schedulesOf(device()))
        for (const float x : {0.0f, 1.02f, 1.05f, 30.0f}) {
            Scene scene = withBall(0.5f, x).build();
            scene.punctualLights.push_back(pointLight({0, 4, 0}, 1.0f));
            EXPECT_EQ(meanAlpha(scene, schedule), x < 1.03f ? 1.0 : 0.0) << x;
        }
}

TEST_F(ShadowCatcher, WithoutLightThereIsNoShadow) {
    for (const Schedule schedule : schedulesOf(device()))
        EXPECT_EQ(meanAlpha(withBall(0.5f, 0.0f).build(), schedule), 0.0);
}

// A ball and a mirror on the ground, and a pane that is half there.
Scene still() {
    Material mirror;
    mirror.roughness = 0.0f;
    Material pane = lambert(glm::vec3(0.4f));
    pane.alphaMode = AlphaMode::blend;
    pane.alpha = 0.5f;
    Scene scene = SceneBuilder()
                      .add(ball({0, 1, 0}, 1.0f), lambert({0.7f, 0.3f, 0.2f}))
                      .add(rectangle({-1, 1, -2}, {2, 0, 1}, {0, 1, 0}), mirror)
                      .add(rectangle({1.5f, 0.7f, 1}, {0.7f, 0, 0}, {0, 0.7f, 0}), pane)
                      .environment(kSky)
                      .camera(lookAt({2, 3, 8}, {0, 0.5f, 0}, 0.7f))
                      .build();
    scene.punctualLights.push_back(pointLight({3, 5, 2}, 40.0f));
    return scene;
}

TEST_F(ShadowCatcher, ModelAndLitGroundKeepTheirBits) {
    for (const Schedule schedule : schedulesOf(device())) {
        SCOPED_TRACE(static_cast<int>(schedule));
        RenderSettings of = settings(schedule, Background::transparent, Ground::none);
        of.image = {48, 48};
        of.stop.samples = 32;
        const Rendering plain = renderScene(device(), still(), of).rendering;
        of.ground.kind = Ground::shadow;
        const Rendering caught = renderScene(device(), still(), of).rendering;
        EXPECT_EQ(caught.radiance().pixels, plain.radiance().pixels); // a mirror does not see the ground
        uint32_t shadowed = 0;
        uint32_t lit = 0;
        for (size_t i = 0; i < plain.radiance().pixels.size(); ++i) {
            const glm::vec3 sums = caught.find("shadow")->mean.pixels[i];
            const float before = plain.find("coverage")->mean.pixels[i].x;
            const float alpha = caught.find("coverage")->mean.pixels[i].x;
            const float shadow = sums.y > 0.0f ? sums.x * (1.0f - sums.z / sums.y) : 0.0f;
            ASSERT_NEAR(alpha, before + shadow, 1e-6f) << i;
            ASSERT_LE(sums.x + before, 1.0f) << i;
            shadowed += shadow > 0.2f ? 1 : 0;
            lit += sums.x == 1.0f && alpha == 0.0f ? 1 : 0;
        }
        EXPECT_GT(shadowed, 100u);
        EXPECT_GT(lit, 20u);
    }
}

// Sums of a filter with negative lobes have signs.
TEST_F(ShadowCatcher, FilteredShadowsAreBetweenNoneAndAll) {
    constexpr std::array kPlaces{0.0f, 0.9f, 1.2f};
    for (const Schedule schedule : schedulesOf(device())) {
        std::vector<double> alphas;
        for (const PixelFilter filter : {PixelFilter::box, PixelFilter::mitchell})
            for (const float x : kPlaces) {
                RenderSettings of = settings(schedule, Background::transparent, Ground::shadow);
                of.estimator.pixelFilter = filter;
                Scene scene = withBall(0.5f, x).environment(glm::vec3(1.0f)).build();
                scene.punctualLights.push_back(pointLight({0, 4, 0}, 40.0f));
                alphas.push_back(0.0);
                const Rendering image = renderScene(device(), scene, of).rendering;
                for (const glm::vec3& pixel : image.find("coverage")->mean.pixels) {
                    EXPECT_GE(pixel.x, 0.0f);
                    EXPECT_LE(pixel.x, 1.0f);
                    alphas.back() += pixel.x / (kSide * kSide);
                }
            }
        for (size_t i = 0; i < kPlaces.size(); ++i)
            EXPECT_NEAR(alphas[kPlaces.size() + i], alphas[i], 0.02) << kPlaces[i];
    }
}

// What is seen of a background through shadows is what they leave of it; so is the layer of what is seen
// directly.
TEST_F(ShadowCatcher, BackgroundsAreDarkenedByAlpha) {
    for (const Schedule schedule : schedulesOf(device())) {
        SCOPED_TRACE(static_cast<int>(schedule));
        RenderSettings of = settings(schedule, Background::transparent, Ground::shadow);
        of.image = {48, 48};
        of.stop.samples = 32;
        of.layers = 1u << kEmissionPlane | 1u << kDirectPlane;
        const Rendering open = renderScene(device(), still(), of).rendering;
        for (const auto& [kind, radiance] :
             {std::pair(Background::constant, kBlue), std::pair(Background::environment, kSky)}) {
            of.background.kind = kind;
            const Rendering seen = renderScene(device(), still(), of).rendering;
            EXPECT_EQ(seen.find("coverage"), nullptr);
            for (size_t i = 0; i < open.radiance().pixels.size(); ++i) {
                const glm::vec3 through = (1.0f - open.find("coverage")->mean.pixels[i].x) * radiance;
                for (glm::length_t c = 0; c < 3; ++c) {
                    ASSERT_NEAR(seen.radiance().pixels[i][c], open.radiance().pixels[i][c] + through[c],
                                3e-6f);
                    ASSERT_NEAR(seen.find("emission")->mean.pixels[i][c], through[c], 3e-6f);
                    ASSERT_NEAR(seen.find("direct")->mean.pixels[i][c],
                                open.find("direct")->mean.pixels[i][c] + through[c], 3e-6f);
                }
            }
        }
    }
}

TEST_F(ShadowCatcher, GroundIsWhereRaysFromAboveComeDown) {
    const auto caught = [&](const glm::vec3& from, const glm::vec3& to, Schedule schedule) {
        Scene scene = withBall(0.5f, 0.0f).environment(glm::vec3(1.0f)).build();
        scene.cameras = {lookAtOrthographic(from, to, 0.01f)};
        return shadow(scene, schedule).find("shadow")->mean.pixels.front().x;
    };
    for (const Schedule schedule : schedulesOf(device())) {
        EXPECT_EQ(caught({5, 1, 0}, {4, 0, 0}, schedule), 1.0f);
        EXPECT_EQ(caught({5, 1, 0}, {4, 2, 0}, schedule), 0.0f);
        EXPECT_EQ(caught({5, -1, 0}, {4, -2, 0}, schedule), 0.0f);
        EXPECT_EQ(caught({5, -1, 0}, {4, 0, 0}, schedule), 0.0f);
        EXPECT_EQ(caught({5, 2, 0}, {0, 2, 0}, schedule), 0.0f) << "the ball";
    }
}

// The ground is 4.5 m away, and a panel below it lets the far plane count.
TEST_F(ShadowCatcher, GroundEndsWithTheView) {
    Scene scene =
        withBall(0.5f, 30.0f).add(rectangle({25, -2.5f, 0}, {0, 0, 1}, {1, 0, 0}), Material()).build();
    scene.punctualLights.push_back(pointLight({0, 4, 0}, 1.0f));
    for (const Schedule schedule : schedulesOf(device()))
        for (const float zfar : {3.0f, 5.0f}) {
            scene.cameras.front().zfar = zfar;
            EXPECT_EQ(shadow(scene, schedule).find("shadow")->mean.pixels.front().x,
                      zfar < 4.0f ? 0.0f : 1.0f);
        }
}

// Light is sampled on the ground whatever finds it elsewhere.
TEST_F(ShadowCatcher, WithoutNextEventEstimationShadowsHaveTheSameBits) {
    for (const Schedule schedule : schedulesOf(device())) {
        RenderSettings of = settings(schedule, Background::transparent, Ground::shadow);
        of.stop.samples = 16;
        Scene scene = withBall(1.5f, 0.0f).environment(glm::vec3(1.0f)).build();
        const Rendering with = renderScene(device(), scene, of).rendering;
        of.estimator.nextEventEstimation = false;
        const Rendering without = renderScene(device(), scene, of).rendering;
        EXPECT_EQ(without.find("shadow")->mean.pixels, with.find("shadow")->mean.pixels);
        EXPECT_GT(with.find("coverage")->mean.pixels.front().x, 0.0f);
    }
}

TEST_F(ShadowCatcher, WavesBandsAndPartsHaveTheSameBits) {
    for (const Background background : {Background::transparent, Background::environment}) {
        std::vector<std::vector<uint32_t>> films;
        for (const Schedule schedule : schedulesOf(device())) {
            SCOPED_TRACE(static_cast<int>(schedule));
            RenderSettings of = settings(schedule, background, Ground::shadow);
            of.image = {40, 36};
            of.stop.samples = 16;
            const auto film = [&] { return renderScene(device(), still(), of).filmWords; };
            films.push_back(film());
            for (const uint32_t waveSize : {1000u, 10007u}) {
                of.work.waveSize = waveSize;
                EXPECT_EQ(film(), films.back()) << waveSize;
            }
            of.work.bandRows = 7;
            EXPECT_EQ(film(), films.back());
            of.stop.samples = 5;
            const std::vector<uint32_t> first = film();
            of.image.firstSample = 5;
            of.stop.samples = 11;
            EXPECT_EQ(sumOfFilms(first, film(), layoutOf(filmPlanes(of))), films.back());
        }
        EXPECT_EQ(films[0], films[1]) << "fused and wavefront";
    }
}

TEST_F(ShadowCatcher, TheHostGivesThePictureOfTheKernelsButForRounding) {
    if (!device().description().sharesMemory)
        GTEST_SKIP() << "the host does not reach the device's memory";
    const auto image = [&](Schedule schedule) {
        RenderSettings of = settings(schedule, Background::environment, Ground::shadow);
        of.image = {40, 36};
        of.stop.samples = 16;
        return renderScene(device(), still(), of).rendering;
    };
    EXPECT_LE(shareThatDiffers(image(Schedule::fused), image(Schedule::hosted)), 0.005);
}

} // namespace
} // namespace lavalight::test
