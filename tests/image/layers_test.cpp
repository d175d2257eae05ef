// What the lobes of glTF's material extensions send where, in scenes with a closed form or against scenes
// without them.
#include <cmath>

#include <gtest/gtest.h>

#include "support/render_scene.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

constexpr glm::vec3 kOrigin(0.0f);

class Layers : public DeviceTest {};

// A floor of that material under a white sky, seen under that angle to its normal.
Scene floorUnderTheSky(const Material& material, float cosTheta) {
    const float sinTheta = std::sqrt(1.0f - cosTheta * cosTheta);
    return SceneBuilder()
        .add(rectangle(kOrigin, {0, 0, 9}, {9, 0, 0}), material)
        .environment(glm::vec3(1.0f))
        .camera(lookAtOrthographic(5.0f * glm::vec3(sinTheta, cosTheta, 0.01f), kOrigin, 0.1f))
        .build();
}

TEST_F(Layers, SmoothClearcoatOnBlackIsAVarnishMirror) {
    Material varnish = lambert(glm::vec3(0.0f));
    varnish.clearcoat = 0.75f;
    for (const float cosTheta : {0.9f, 0.4f}) {
        const Scene scene = floorUnderTheSky(varnish, cosTheta);
        const double cosine = glm::normalize(scene.cameras.front().position).y;
        const double fresnel = 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
        expectEveryPixel(renderScene(device(), scene, imageSettings(8, 8, 4)), glm::dvec3(0.75 * fresnel));
    }
}

// Each point of the paper sends t of what falls on it from outside to the inside, where the rest of the body
// sees it and sends back r: L = t + r L.
TEST_F(Layers, LanternOfPaperGlowsByItsTransmission) {
    Material paper = lambert({0.8f, 0.5f, 0.9f});
    paper.diffuseTransmission = 0.4f;
    paper.diffuseTransmissionColor = {1.0f, 0.7f, 0.2f};
    paper.doubleSided = true;
    const Scene scene = SceneBuilder()
                            .add(ball(kOrigin, 1.0f), paper)
                            .environment(glm::vec3(1.0f))
                            .camera(lookAt({0.1f, -0.2f, 0.05f}, {1.0f, 0.1f, 0.3f}, 1.2f))
                            .build();
    const glm::dvec3 transmitted = 0.4 * glm::dvec3(paper.diffuseTransmissionColor);
    const glm::dvec3 reflected = 0.6 * glm::dvec3(paper.baseColor);
    for (const Hemisphere hemisphere : {Hemisphere::cosine, Hemisphere::uniform}) {
        RenderSettings settings = imageSettings(32, 32, 64);
        settings.estimator.hemisphere = hemisphere;
        expectMean(renderScene(device(), scene, settings), transmitted / (1.0 - reflected), 0.01);
    }
}

// Brushed metal from above, with a lamp to one side of it.
Scene brushedFloor(float rotation, const glm::vec3& lamp) {
    Material metal;
    metal.roughness = 0.2f;
    metal.anisotropy = 0.8f;
    metal.anisotropyRotation = rotation;
    return SceneBuilder()
        .add(rectangle(kOrigin, {0, 0, 1}, {1, 0, 0}), metal)
        .add(ball(3.0f * lamp, 0.5f), light(glm::vec3(10.0f)))
        .camera(lookAtOrthographic({0.0f, 6.0f, 1e-3f}, kOrigin, 0.05f))
        .build();
}

TEST_F(Layers, AnisotropyTurnsWithItsRotation) {
    constexpr float quarterTurn = 1.5707963f;
    const glm::vec3 towardsX(0.6f, 0.8f, 0.0f);
    const glm::vec3 towardsZ(0.0f, 0.8f, 0.6f);
    const RenderSettings settings = imageSettings(16, 16, 256);
    const auto brightness = [&](float rotation, const glm::vec3& lamp) {
        return meanOf(renderScene(device(), brushedFloor(rotation, lamp), settings).rendering);
    };
    const ImageMean along = brightness(0.0f, towardsX);
    const ImageMean turned = brightness(quarterTurn, towardsZ);
    const ImageMean across = brightness(0.0f, towardsZ);
    EXPECT_NEAR(along.mean.x, turned.mean.x, 0.02 * along.mean.x); // the balls' facets lie differently
    EXPECT_LT(across.mean.x, 0.2 * along.mean.x);
}

// A prism of glass between a bright panel and the camera.
Scene prism(float ior, float dispersion) {
    Material glass = lambert(glm::vec3(1.0f));
    glass.specular = 1.0f;
    glass.transmission = 1.0f;
    glass.roughness = 0.0f;
    glass.isSolid = true;
    glass.ior = ior;
    glass.dispersion = dispersion;
    return SceneBuilder()
        .add(ball({0, 1, 0}, 1.0f), glass)
        .add(rectangle({0, 0, 0}, {0, 0, 4}, {4, 0, 0}), lambert({0.7f, 0.6f, 0.5f}))
        .add(rectangle({0, 2, -3}, {2, 0, 0}, {0, 1, 0}), light({3, 4, 5}))
        .environment({0.3f, 0.2f, 0.1f})
        .camera(lookAt({0, 2, 6}, {0, 1, 0}, 0.5f))
        .build();
}

TEST_F(Layers, DispersedLightIsThatOfThreeIndices) {
    constexpr float ior = 1.6f;
    constexpr float dispersion = 4.0f;
    constexpr float halfSpread = (ior - 1.0f) * 0.025f * dispersion;
    RenderSettings settings = imageSettings(48, 48, 256);
    settings.estimator.sampler = Sampler::independent;
    const Rendering dispersed = renderScene(device(), prism(ior, dispersion), settings).rendering;
    settings.estimator.seed = 7;
    Rendering joined = dispersed;
    for (glm::length_t channel = 0; channel < 3; ++channel) {
        const float own = ior + halfSpread * static_cast<float>(channel - 1);
        const Rendering single = renderScene(device(), prism(own, 0.0f), settings).rendering;
        for (size_t i = 0; i < joined.radiance().pixels.size(); ++i) {
            joined.radiance().pixels[i][channel] = single.radiance().pixels[i][channel];
            joined.variance().pixels[i][channel] = single.variance().pixels[i][channel];
        }
    }
    expectSameMean(dispersed, joined, 8);
    const Rendering undispersed = renderScene(device(), prism(ior, 0.0f), settings).rendering;
    const glm::dvec3 change = meanOf(undispersed).mean - meanOf(joined).mean;
    EXPECT_GT(glm::length(change), 4.0 * glm::length(meanOf(joined).standardError)) << "shows nothing";
}

} // namespace
} // namespace lavalight::test
