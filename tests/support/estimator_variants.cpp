#include "support/estimator_variants.h"

#include <iostream>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "render/setting_text.h"
#include "support/mean_test.h"
#include "support/render_scene.h"

namespace lavalight::test {
namespace {

constexpr uint32_t kSide = 32;

// One value of one setting, which is not the default.
struct Change {
    const SettingRow* row;
    uint32_t value;
};

// By setting: its values that must not change the mean. The sampler is left out: Z-tests want independent
// samples.
std::vector<std::vector<Change>> changes() {
    std::vector<std::vector<Change>> all;
    for (const SettingRow& row : settingRows()) {
        const auto* values = std::get_if<NamedValues>(&row.values);
        if (values == nullptr || row.mayChangeMean || row.name == "sampler")
            continue;
        std::vector<Change>& ofRow = all.emplace_back();
        for (const SettingName<uint32_t>& name : values->names.subspan(1))
            ofRow.push_back({&row, name.value});
    }
    return all;
}

void apply(Variant& variant, const Change& change) {
    std::get<NamedValues>(change.row->values).set(variant.settings, change.value);
    variant.name += fmt::format("{}--{} {}", variant.name.empty() ? "" : " ", change.row->name,
                                textOf(*change.row, variant.settings));
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
                 const MeanEffort& effort) {
    RenderSettings settings = imageSettings(kSide, kSide, effort.samples);
    settings.estimator = estimator;
    settings.estimator.maxBounces = effort.maxBounces;
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
    for (const std::vector<Change>& setting : changes())
        for (const Change& change : setting) {
            Variant variant = withOtherSeed();
            apply(variant, change);
            // Where it contradicts the defaults: with what comes before it in the table.
            for (auto earlier = variants.rbegin(); !isPermitted(variant) && earlier != variants.rend();
                 ++earlier) {
                variant = *earlier;
                apply(variant, change);
            }
            variants.push_back(std::move(variant));
        }
    for (Variant& variant : variants)
        if (!variant.settings.nextEventEstimation)
            variant.effort = 4;
    return variants;
}

std::vector<Variant> variantsOfDirections() {
    const EstimatorSettings usual = defaultVariant().settings;
    std::vector<Variant> variants = singleVariants();
    std::erase_if(variants, [&](const Variant& variant) {
        const EstimatorSettings& s = variant.settings;
        const bool isUsualRoulette = s.roulette == usual.roulette && s.misSurvival == usual.misSurvival;
        return s.lightSelection != usual.lightSelection ||
               (!isUsualRoulette && s.roulette != Roulette::off && s.misSurvival == usual.misSurvival);
    });
    return variants;
}

std::vector<Variant> allVariants() {
    std::vector<Variant> variants{withOtherSeed()};
    for (const std::vector<Change>& setting : changes()) {
        const std::vector<Variant> before = variants;
        for (const Change& change : setting)
            for (Variant variant : before) {
                apply(variant, change);
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
                   const MeanEffort& effort) {
    const auto times = [&](uint32_t factor) {
        MeanEffort more = effort;
        more.samples *= factor;
        return more;
    };
    const Rendering expected = render(device, scene, defaultVariant().settings, times(2));
    for (const Variant& variant : variants) {
        const Rendering image = render(device, scene, variant.settings, times(variant.effort));
        const MeanComparison comparison = compareMeans(image, expected);
        std::cout << variant.name << ": " << comparison.text() << std::endl;
        EXPECT_GE(comparison.share, effort.leastShare) << variant.name << ": too noisy to say anything";
        EXPECT_TRUE(comparison.same())
            << variant.name << ": " << comparison.text() << "; difference times 10: "
            << writeDifference(image.radiance(), expected.radiance(), 10.0f, "estimator");
    }
}

} // namespace lavalight::test
