// Estimators change the noise of an image, never its mean: each setting against the default on each scene.
#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "session/builtin.h"
#include "support/estimator_variants.h"
#include "support/scene_builder.h"
#include "support/test_device.h"

namespace lavalight::test {
namespace {

// A scene, how much is done to find a bias, and in which variants: where one lamp is the only light, ways to
// pick a light change nothing. Each test prints which bias it would notice.
struct Subject {
    const char* name;
    MeanEffort effort;
    std::vector<Variant> (*variants)() = singleVariants;
};

std::ostream& operator<<(std::ostream& out, const Subject& subject) {
    return out << subject.name;
}

class EstimatorTest : public DeviceTest, public testing::WithParamInterface<Subject> {};

TEST_P(EstimatorTest, EverySettingHasTheMeanOfTheDefault) {
    const std::string scene = GetParam().name;
    expectOneMean(device(), loadScene(scene), answerable(scene, GetParam().variants()), GetParam().effort);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EstimatorTest,
                         testing::Values(Subject{"cornell-box", {512, 0.5}},
                                         Subject{"cornell-glass", {512, 0.5}, variantsOfDirections},
                                         Subject{"veach-mis", {1024, 0.1}},
                                         Subject{"many-lights", {512, 0.1}}, Subject{"furnace", {256, 0.5}},
                                         Subject{"large-small-light", {1024, 0.1}},
                                         Subject{"glass-caustic", {1024, 0.1}, variantsOfDirections},
                                         Subject{"nested-glass", {128, 0.3, 12}}),
                         [](const auto& subject) {
                             std::string name = subject.param.name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

// Metal and glossy dielectric under two lights of unequal size: weights between lobes and light samples
// matter.
Scene glossyScene() {
    Material floor = lambert({0.6f, 0.5f, 0.4f});
    floor.specular = 1.0f;
    floor.roughness = 0.3f;
    Material metal = lambert({0.9f, 0.7f, 0.5f});
    metal.metallic = 1.0f;
    metal.roughness = 0.4f;
    return SceneBuilder()
        .add(rectangle({0, 0, 0}, {0, 0, 4}, {4, 0, 0}), floor)
        .add(ball({0, 1, 0}, 1.0f), metal)
        .add(rectangle({0, 4, 0}, {1.5f, 0, 0}, {0, 0, 1.5f}), light({3, 3, 4}))
        .add(rectangle({2, 2, 1}, {0.2f, 0, 0}, {0, 0, 0.2f}), light({20, 10, 5}))
        .camera(lookAt({2, 3, 5}, {0, 0.5f, 0}, 0.7f))
        .build();
}

// Rough glass, a rough thin wall, a small light and a sky.
Scene glassScene() {
    Material glass = lambert(glm::vec3(0.9f, 1.0f, 0.95f));
    glass.transmission = 1.0f;
    glass.isSolid = true;
    glass.roughness = 0.3f;
    Material pane = glass;
    pane.isSolid = false;
    pane.transmission = 0.7f;
    return SceneBuilder()
        .add(rectangle({0, 0, 0}, {0, 0, 4}, {4, 0, 0}), lambert({0.6f, 0.5f, 0.4f}))
        .add(ball({-0.8f, 1, 0}, 0.9f), glass)
        .add(rectangle({1.2f, 1, 0}, {0.7f, 0, 0.3f}, {0, 0.9f, 0}), pane)
        .add(rectangle({0, 4, 0}, {0.7f, 0, 0}, {0, 0, 0.7f}), light({8, 8, 9}))
        .environment({0.2f, 0.25f, 0.3f})
        .camera(lookAt({1, 2, 6}, {0, 0.9f, 0}, 0.6f))
        .build();
}

// A varnished metal, velvet, a leaf of paper, brushed metal and a soap film on glass.
Scene layeredScene() {
    Material varnished = lambert({0.8f, 0.2f, 0.1f});
    varnished.specular = 1.0f;
    varnished.roughness = 0.5f;
    varnished.clearcoat = 1.0f;
    varnished.clearcoatRoughness = 0.0f;
    Material velvet = lambert({0.2f, 0.1f, 0.4f});
    velvet.sheenColor = {0.9f, 0.7f, 0.9f};
    velvet.sheenRoughness = 0.3f;
    velvet.clearcoat = 0.3f;
    velvet.clearcoatRoughness = 0.4f;
    Material leaf = lambert({0.3f, 0.7f, 0.1f});
    leaf.diffuseTransmission = 0.5f;
    leaf.diffuseTransmissionColor = {0.9f, 0.8f, 0.2f};
    leaf.doubleSided = true;
    Material brushed;
    brushed.roughness = 0.3f;
    brushed.anisotropy = 0.7f;
    brushed.iridescence = 1.0f;
    return SceneBuilder()
        .add(rectangle({0, 0, 0}, {0, 0, 4}, {4, 0, 0}), velvet)
        .add(ball({-1.1f, 0.8f, 0}, 0.8f), varnished)
        .add(ball({0.9f, 0.7f, -0.5f}, 0.7f), brushed)
        .add(rectangle({0.6f, 1.2f, 1}, {0.7f, 0, 0.3f}, {0, 0.5f, 0}), leaf)
        .add(rectangle({0, 4, -1}, {1.2f, 0, 0}, {0, 0, 1.2f}), light({4, 4, 5}))
        .environment({0.2f, 0.25f, 0.3f})
        .camera(lookAt({1, 2, 6}, {0, 0.9f, 0}, 0.6f))
        .build();
}

class MaterialsTest : public EstimatorTest {
  protected:
    static Scene sceneOf(const std::string& name) {
        if (name == "layered")
            return layeredScene();
        return name == "glass" ? glassScene() : glossyScene();
    }
};

// Each scene gets a lamp without size too, which nothing but next-event estimation finds.
TEST_P(MaterialsTest, EverySettingHasTheMeanOfTheDefault) {
    Scene scene = sceneOf(GetParam().name);
    PunctualLight lamp;
    lamp.position = {2.0f, 3.0f, 2.0f};
    lamp.intensity = glm::vec3(4.0f);
    scene.punctualLights.push_back(lamp);
    std::vector<Variant> variants = variantsOfDirections();
    std::erase_if(variants, [](const Variant& v) { return !v.settings.nextEventEstimation; });
    expectOneMean(device(), scene, variants, GetParam().effort);
}

INSTANTIATE_TEST_SUITE_P(Scenes, MaterialsTest,
                         testing::Values(Subject{"glossy", {256, 0.5}}, Subject{"glass", {256, 0.5}},
                                         Subject{"layered", {256, 0.5}}),
                         [](const auto& subject) { return std::string(subject.param.name); });

} // namespace
} // namespace lavalight::test
