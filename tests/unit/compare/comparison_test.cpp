// What is asked of the layers of two images besides their colour.
#include "compare/comparison.h"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "compare/comparison_output.h"

namespace lavalight {
namespace {

constexpr uint32_t kSide = 8;

Image filled(const glm::vec3& value) {
    Image image(kSide, kSide);
    std::fill(image.pixels.begin(), image.pixels.end(), value);
    return image;
}

// Equal colours of 16 samples, and a layer of one component.
ComparedImage withDepth(float depth, std::optional<float> variance) {
    ComparedImage image{"some.exr", {}, false};
    image.content.layers.push_back(colorLayer(filled(glm::vec3(1.0f)), filled(glm::vec3(0.01f))));
    image.content.layers.push_back({"depth", {"depth.Z"}, filled({depth, 0.0f, 0.0f}), std::nullopt});
    if (variance)
        image.content.layers.back().variance = filled({*variance, 0.0f, 0.0f});
    image.content.sampleCounts.assign(size_t{kSide} * kSide, 16);
    return image;
}

TEST(ComparedLayers, WithVariancesAreTestedAsTheColourIs) {
    const ComparedImage reference = withDepth(10.0f, 0.5f);
    EXPECT_TRUE(compare(withDepth(10.05f, 0.5f), reference, {}).isEqual());
    const Comparison apart = compare(withDepth(12.0f, 0.5f), reference, {});
    EXPECT_FALSE(apart.isEqual());
    ASSERT_EQ(apart.verdicts.size(), 3u); // finite, the colour's Z-test, the layer's
    EXPECT_TRUE(apart.verdicts[1].passed);
    EXPECT_EQ(apart.verdicts[2].criterion, "Z-test of depth");
    EXPECT_TRUE(apart.verdicts[2].isZTest());
    EXPECT_NE(apart.verdicts[2].where.find("depth.Z"), std::string::npos) << apart.verdicts[2].where;
}

TEST(ComparedLayers, WithoutVariancesAreHeldToTheirRelMse) {
    const ComparedImage reference = withDepth(10.0f, std::nullopt);
    EXPECT_TRUE(compare(withDepth(10.5f, std::nullopt), reference, {}).isEqual());
    const Comparison apart = compare(withDepth(12.0f, std::nullopt), reference, {});
    ASSERT_EQ(apart.layers.size(), 1u);
    EXPECT_NEAR(apart.layers.front().rmse, 2.0, 1e-6) << "of one component, not of three";
    EXPECT_NEAR(apart.layers.front().relMse, 4.0 / 100.01, 1e-6);
    EXPECT_FALSE(apart.layers.front().zTests.has_value());
    EXPECT_FALSE(apart.isEqual());
    EXPECT_EQ(apart.verdicts.back().criterion, "relMSE of depth");
    Criteria lenient;
    lenient.relMse = 0.05;
    EXPECT_TRUE(compare(withDepth(12.0f, std::nullopt), reference, lenient).isEqual());
    lenient.relMse = 0.03;
    EXPECT_FALSE(compare(withDepth(12.0f, std::nullopt), reference, lenient).isEqual());
}

TEST(ComparedLayers, OnlyThoseOfBothCount) {
    ComparedImage reference = withDepth(10.0f, 0.5f);
    reference.content.layers.back().name = "height";
    const Comparison comparison = compare(withDepth(99.0f, 0.5f), reference, {});
    EXPECT_TRUE(comparison.layers.empty());
    EXPECT_TRUE(comparison.isEqual());
    EXPECT_FALSE(comparisonJson(comparison).contains("layers"));
}

TEST(ComparedLayers, AreInTheTextAndInTheJson) {
    const Comparison comparison = compare(withDepth(12.0f, 0.5f), withDepth(10.0f, 0.5f), {});
    const std::string text = comparisonText(comparison);
    EXPECT_NE(text.find("layer depth       RMSE 2, relMSE 0.039996, p of the Z-test"), std::string::npos)
        << text;
    const nlohmann::ordered_json json = comparisonJson(comparison);
    EXPECT_NEAR(json["layers"]["depth"]["rmse"].get<double>(), 2.0, 1e-6);
    EXPECT_FALSE(json["layers"]["depth"]["zTest"].is_null());
}

} // namespace
} // namespace lavalight
