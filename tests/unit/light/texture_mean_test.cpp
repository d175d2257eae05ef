// The mean of a texture over a triangle is that of all its points, for every filter and wrap mode.
#include "light/texture_mean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "image/texel.h"
#include "support/pictures.h"
#include "support/random_numbers.h"

namespace lavalight::test {
namespace {

glm::dvec3 at(const Picture& picture, const Texture& t, const glm::dvec2& uv) {
    const glm::dvec2 p = uv * glm::dvec2(picture.width, picture.height) - (t.isNearest ? 0.0 : 0.5);
    const glm::dvec2 low = glm::floor(p);
    const glm::dvec2 f = t.isNearest ? glm::dvec2(0.0) : p - low;
    glm::dvec3 sum(0.0);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
            sum += (i == 1 ? f.x : 1.0 - f.x) * (j == 1 ? f.y : 1.0 - f.y) *
                   glm::dvec3(texelOf(
                       picture, wrapTexel(static_cast<int64_t>(low.x) + i, picture.width, t.wrapU),
                       wrapTexel(static_cast<int64_t>(low.y) + j, picture.height, t.wrapV), t.isSrgb));
    return sum;
}

// Mean at the middles of 400 x 400 parts of the triangle.
glm::dvec3 meanOfPoints(const Picture& picture, const Texture& t, const std::array<glm::vec2, 3>& uvs) {
    constexpr int kParts = 400;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kParts; ++i)
        for (int j = 0; i + j < kParts; ++j)
            for (const double middle : {1.0 / 3.0, 2.0 / 3.0}) {
                if (middle > 0.5 && i + j + 1 >= kParts)
                    continue;
                const double b1 = (i + middle) / kParts;
                const double b2 = (j + middle) / kParts;
                sum += at(picture, t,
                          (1.0 - b1 - b2) * glm::dvec2(uvs[0]) + b1 * glm::dvec2(uvs[1]) +
                              b2 * glm::dvec2(uvs[2]));
            }
    return sum / double{kParts * kParts};
}

Texture anyTexture(Random& random) {
    Texture texture = textureOf(0);
    texture.isNearest = random.unit() < 0.5f;
    texture.isSrgb = random.unit() < 0.5f;
    texture.wrapU = static_cast<Wrap>(random.bits() % 3);
    texture.wrapV = static_cast<Wrap>(random.bits() % 3);
    return texture;
}

TEST(TextureMean, IsTheMeanOfThePoints) {
    Random random(1);
    for (int i = 0; i < 60; ++i) {
        const Picture picture =
            noisePicture(1 + random.bits() % 9, 1 + random.bits() % 9, false, random.bits());
        const Texture texture = anyTexture(random);
        std::array<glm::vec2, 3> uvs;
        for (glm::vec2& uv : uvs)
            uv = {random.between(-1.5f, 2.5f), random.between(-1.5f, 2.5f)};
        const glm::dvec3 expected = meanOfPoints(picture, texture, uvs);
        const glm::dvec3 mean = TextureMean(picture, texture).over(uvs);
        EXPECT_LT(glm::length(mean - expected), 4e-3) << i;
    }
}

TEST(TextureMean, FollowsTheTransform) {
    const Picture picture = noisePicture(8, 8, false, 3);
    Texture texture = textureOf(0);
    texture.uRow = {0.0f, 0.5f, 0.25f};
    texture.vRow = {-1.0f, 0.0f, 0.5f};
    const std::array<glm::vec2, 3> moved{{{0.25f, 0.5f}, {0.25f, -0.5f}, {0.75f, 0.5f}}};
    const glm::dvec3 mean = TextureMean(picture, texture).over({{{0, 0}, {1, 0}, {0, 1}}});
    EXPECT_LT(glm::length(mean - TextureMean(picture, textureOf(0)).over(moved)), 1e-6);
}

TEST(TextureMean, OfManyTexelsIsCloseAndKeepsWhatIsNotBlack) {
    Picture picture = noisePicture(700, 501, false, 5);
    const std::array<glm::vec2, 3> half{{{0, 0}, {1, 0}, {0, 1}}};
    const glm::dvec3 expected = meanOfPoints(picture, textureOf(0), half);
    EXPECT_LT(glm::length(TextureMean(picture, textureOf(0)).over(half) - expected), 0.01);
    picture.bytes.assign(picture.bytes.size(), 0);
    EXPECT_EQ(TextureMean(picture, textureOf(0)).over(half), glm::dvec3(0.0));
    picture.bytes[4 * (100 * 700 + 200)] = 1;
    EXPECT_GT(TextureMean(picture, textureOf(0)).over(half).r, 0.0);
}

// The picture has one lit texel. Small triangles beside it see black, and others see what their points do.
TEST(TextureMean, OfAPictureThatIsAlmostBlackIsTheMeanOfThePoints) {
    constexpr uint32_t kSide = 4;
    Random random(2);
    int black = 0;
    int lit = 0;
    for (int i = 0; i < 150; ++i) {
        Picture picture = pictureOf(kSide, kSide, std::vector<glm::uvec4>(kSide * kSide));
        picture.bytes[4 * (random.bits() % (kSide * kSide))] = 255;
        const Texture texture = anyTexture(random);
        const glm::vec2 middle(random.between(-1.5f, 2.5f), random.between(-1.5f, 2.5f));
        std::array<glm::vec2, 3> uvs;
        for (glm::vec2& uv : uvs)
            uv = middle + 0.15f * glm::vec2(random.between(-1.0f, 1.0f), random.between(-1.0f, 1.0f));
        const double expected = meanOfPoints(picture, texture, uvs).r;
        const double mean = TextureMean(picture, texture).over(uvs).r;
        EXPECT_NEAR(mean, expected, 4e-3) << i;
        EXPECT_GE(mean > 0.0, expected > 0.0) << i;
        ++(expected > 0.0 ? lit : black);
    }
    EXPECT_GT(std::min(black, lit), 20);
}

TEST(TextureMean, OfATriangleThatIsAPointInThePictureIsThatTexel) {
    const Picture picture = noisePicture(4, 4, false, 7);
    const glm::vec2 uv(0.6f, 0.3f);
    const glm::dvec3 mean = TextureMean(picture, textureOf(0)).over({uv, uv, uv});
    EXPECT_LT(glm::length(mean - at(picture, textureOf(0), glm::dvec2(uv))), 1e-6);
}

// Coordinates that 64 bits cannot count texels by are read as those of the first texel.
TEST(TextureMean, OfCoordinatesFarOutIsThatOfTheFirstTexel) {
    Picture picture = pictureOf(3, 3, std::vector<glm::uvec4>(9));
    picture.bytes[0] = 255;
    const glm::vec2 far(1e30f);
    EXPECT_EQ(TextureMean(picture, textureOf(0)).over({far, far, far}).r, 1.0);
}

} // namespace
} // namespace lavalight::test
