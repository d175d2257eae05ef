#include "support/estimator_variants.h"

#include <functional>
#include <iostream>

#include <gtest/gtest.h>

#include "base/error.h"
#include "support/mean_test.h"
#include "support/render_scene.h"

namespace lavalight::test {
namespace {

using Change = std::function<void(EstimatorSettings&)>;

constexpr uint32_t kSide = 32;
constexpr uint32_t kMaxBounces = 4; // of all that is compared: without roulette, paths would run on to 64

// One value of one setting; an empty option is the default.
struct Choice {
    std::string option;
    Change change;
};

Change roulette(Roulette kind) {
    return [kind](EstimatorSettings& s) { s.roulette = kind; };
}

Choice survivalOn() {
    return {"--mis-survival on", [](EstimatorSettings& s) { s.misSurvival = true; }};
}

// The settings with their values beside the default, in the order of DESIGN section 5.
std::vector<std::vector<Choice>> settings() {
    return {
        {{"--hemisphere uniform", [](EstimatorSettings& s) { s.hemisphere = Hemisphere::uniform; }}},
        {{"--nee off", [](EstimatorSettings& s) { s.nextEventEstimation = false; }}},
        {{"--light-selection uniform",
          [](EstimatorSettings& s) { s.lightSelection = LightSelection::uniform; }},
         {"--light-selection tree", [](EstimatorSettings& s) { s.lightSelection = LightSelection::tree; }}},
        {{"--mis balance", [](EstimatorSettings& s) { s.mis = Mis::balance; }},
         {"--mis off", [](EstimatorSettings& s) { s.mis = Mis::off; }}},
        {{"--roulette throughput", roulette(Roulette::throughput)},
         {"--roulette off", roulette(Roulette::off)},
         {"--roulette constant", roulette(Roulette::constant)},
         {"--roulette mean-albedo", roulette(Roulette::meanAlbedo)},
         {"--roulette max-albedo", roulette(Roulette::maxAlbedo)}},
    };
}

void apply(Variant& variant, const Choice& choice) {
    variant.name += (variant.name.empty() ? "" : " ") + choice.option;
    choice.change(variant.settings);
}

Variant withOtherSeed() {
    Variant variant = defaultVariant();
    variant.settings.seed = 1;
    return variant;
}

bool isPermitted(const Variant& variant) {
    RenderSettings settings;
    settings.estimator = variant.settings;
    settings.image.width = 1;
    try {
        checkSettings(settings);
        return true;
    } catch (const Error&) {
        return false;
    }
}

Rendering render(gpu::Device& device, const Scene& scene, const EstimatorSettings& estimator,
                 uint32_t samples) {
    RenderSettings settings = imageSettings(kSide, kSide, samples);
    settings.estimator = estimator;
    settings.estimator.maxBounces = kMaxBounces;
    const RenderResult result = renderScene(device, scene, settings);
    EXPECT_EQ(result.tallies.droppedSamples, 0u);
    return result.rendering;
}

} // namespace

Variant defaultVariant() {
    Variant variant;
    variant.settings.sampler = Sampler::independent;
    return variant;
}

std::vector<Variant> singleVariants() {
    std::vector<Variant> variants;
    for (const std::vector<Choice>& setting : settings())
        for (const Choice& choice : setting)
            apply(variants.emplace_back(withOtherSeed()), choice);
    for (Variant& variant : variants)
        if (!variant.settings.nextEventEstimation)
            variant.effort = 2;
    // Needs a roulette by albedo.
    variants.push_back(variants.back());
    apply(variants.back(), survivalOn());
    return variants;
}

std::vector<Variant> allVariants() {
    std::vector<Variant> variants{withOtherSeed()};
    std::vector<std::vector<Choice>> all = settings();
    all.push_back({survivalOn()});
    for (const std::vector<Choice>& setting : all) {
        const std::vector<Variant> before = variants;
        for (const Choice& choice : setting)
            for (Variant variant : before) {
                apply(variant, choice);
                variants.push_back(std::move(variant));
            }
    }
    std::erase_if(variants, [](const Variant& variant) { return !isPermitted(variant); });
    return variants;
}

std::vector<Variant> answerable(const std::string& scene, std::vector<Variant> variants) {
    if (scene == "veach-mis")
        std::erase_if(variants, [](const Variant& variant) {
            return variant.settings.nextEventEstimation && variant.settings.mis == Mis::off;
        });
    return variants;
}

void expectOneMean(gpu::Device& device, const Scene& scene, const std::vector<Variant>& variants,
                   uint32_t samples, double leastShare) {
    const Rendering expected = render(device, scene, defaultVariant().settings, 2 * samples);
    for (const Variant& variant : variants) {
        const Rendering image = render(device, scene, variant.settings, variant.effort * samples);
        const MeanComparison comparison = compareMeans(image, expected);
        std::cout << variant.name << ": " << comparison.text() << std::endl;
        EXPECT_GE(comparison.share, leastShare) << variant.name << ": too noisy to say anything";
        EXPECT_TRUE(comparison.same())
            << variant.name << ": " << comparison.text() << "; difference times 10: "
            << writeDifference(image.radiance, expected.radiance, 10.0f, "estimator");
    }
}

} // namespace lavalight::test
