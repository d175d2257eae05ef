// What shadows on the ground do to alpha and colour.
#include "film/film_shadow.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "film/film_layout.h"
#include "film/raw_film.h"

namespace lavalight {
namespace {

// A row of pixels with means of these planes, all 0.
Rendering pixels(uint32_t planes, uint32_t count) {
    return emptyRendering(layoutOf(planes | 1u << kColorPlane), count, 1);
}

Image& meanOf(Rendering& rendering, uint32_t row) {
    for (Layer& layer : rendering.layers)
        if (layer.name == planeName(row))
            return layer.mean;
    throw std::logic_error("no such layer");
}

TEST(FilmShadow, AlphaIsWhatIsCaughtTimesTheShareOfLightThatIsKept) {
    EXPECT_FLOAT_EQ(shadowAlpha({0.5f, 8.0f, 2.0f}), 0.375f);
    EXPECT_EQ(shadowAlpha({0.5f, 8.0f, 8.0f}), 0.0f);
    EXPECT_EQ(shadowAlpha({0.5f, 8.0f, 0.0f}), 0.5f);
    EXPECT_EQ(shadowAlpha({0.5f, 0.0f, 0.0f}), 0.0f); // no light
    const float largest = std::numeric_limits<float>::infinity();
    EXPECT_EQ(shadowAlpha({1.0f, largest, largest}), 0.0f); // sums beyond their range
}

TEST(FilmShadow, IsAddedToCoverageAndLeavesColour) {
    Rendering image = pixels(1u << kCoveragePlane | 1u << kShadowPlane, 3);
    meanOf(image, kCoveragePlane).pixels = {{0.25f, 0, 0}, {0, 0, 0}, {0.75f, 0, 0}};
    meanOf(image, kShadowPlane).pixels = {{0.5f, 4.0f, 1.0f}, {0.3f, 0.7f, 0.2f}, {0.5f, 4.0f, 0.0f}};
    meanOf(image, kColorPlane).pixels.assign(3, glm::vec3(2.0f));
    castShadows(image, 0, 3);
    const Image& alpha = meanOf(image, kCoveragePlane);
    EXPECT_EQ(alpha.pixels[0].x, 0.625f);
    EXPECT_EQ(alpha.pixels[2].x, 1.0f); // never more
    for (const glm::vec3& color : image.radiance().pixels)
        EXPECT_EQ(color, glm::vec3(2.0f));
    const Image model = coverageWithoutShadow(image).value();
    EXPECT_EQ(model.pixels[0].x, 0.25f);
    EXPECT_EQ(model.pixels[1].x, 0.0f); // exactly
    EXPECT_FALSE(coverageWithoutShadow(pixels(0, 1)).has_value());
}

TEST(FilmShadow, DarkensTheBackgroundOfColourAndEmissionInItsPixelsAlone) {
    Rendering image = pixels(1u << kEmissionPlane | 1u << kShadowPlane | 1u << kBehindPlane, 2);
    meanOf(image, kColorPlane).pixels.assign(2, {3.0f, 2.0f, 0.5f});
    meanOf(image, kEmissionPlane).pixels.assign(2, glm::vec3(2.0f));
    meanOf(image, kShadowPlane).pixels.assign(2, {0.5f, 4.0f, 1.0f});
    meanOf(image, kBehindPlane).pixels.assign(2, {2.0f, 1.0f, 0.8f});
    castShadows(image, 1, 1);
    EXPECT_EQ(image.radiance().pixels[0], glm::vec3(3.0f, 2.0f, 0.5f));
    EXPECT_EQ(image.radiance().pixels[1],
              glm::vec3(1.5f, 1.25f, 0.0f)); // not below 0, which rounding may bring
    EXPECT_EQ(meanOf(image, kEmissionPlane).pixels[1], glm::vec3(0.5f, 1.25f, 1.4f));
}

} // namespace
} // namespace lavalight
