// Where the words of a film's planes are, and how its header names them.
#include "film/film_layout.h"

#include <gtest/gtest.h>

#include "support/film_files.h"

namespace lavalight {
namespace {

using test::signedLayout;

TEST(FilmLayout, ColourAloneHasTheWordsThatItAlwaysHad) {
    EXPECT_EQ(colorLayout().words(), 22u);
    EXPECT_EQ(colorLayout().countWord(), 21u);
    EXPECT_EQ(colorLayout().firstWord(kColorPlane), 0u);
    const std::vector<FilmNumber> numbers = colorLayout().numbers();
    ASSERT_EQ(numbers.size(), 6u);
    EXPECT_EQ(numbers[2].name, "G.sum");
    EXPECT_EQ(numbers[2].firstWord, 7u);
    EXPECT_EQ(numbers[3].name, "G.square");
    EXPECT_EQ(numbers[3].firstWord, 10u);
    EXPECT_EQ(numbers[3].words, 4u);
}

TEST(FilmLayout, SignedSumsHaveAWordMoreAndPlanesWithoutSquaresNone) {
    const FilmLayout layout = signedLayout();
    EXPECT_EQ(layout.firstWord(1), 21u);
    EXPECT_EQ(layout.firstWord(2), 21u + 2 * 4);
    EXPECT_EQ(layout.countWord(), 21u + 2 * 4 + (4 + 4));
    const std::vector<FilmNumber> numbers = layout.numbers();
    ASSERT_EQ(numbers.size(), 6u + 2 + 2);
    EXPECT_EQ(numbers[7].name, "tilt.Y.sum");
    EXPECT_EQ(numbers[7].firstWord, 25u);
    EXPECT_TRUE(numbers[7].isSigned);
    EXPECT_EQ(numbers[9].name, "height.Z.square");
    EXPECT_EQ(numbers[9].firstWord, 33u);
    EXPECT_FALSE(numbers[9].isSigned);
}

// The kernels' macros and FilmLayout compute the same from the rows of planes.
TEST(FilmLayout, SharedFunctionsAgreeWithIt) {
    for (uint32_t rows = 1; rows < 1u << kFilmPlaneCount; rows += 2) {
        const uint32_t asked = rows | ((rows & 2u) != 0 ? kNegativeWeights : 0u);
        const FilmLayout layout = layoutOf(asked);
        EXPECT_EQ(countWordOf(asked), layout.countWord());
        size_t index = 0;
        for (uint32_t plane = 0; plane < kFilmPlaneCount; ++plane)
            if ((asked >> plane & 1u) != 0) {
                EXPECT_EQ(firstWordOf(plane, asked), layout.firstWord(index++)) << plane;
            }
        EXPECT_EQ(index, layout.planes().size());
    }
}

TEST(FilmLayout, NegativeWeightsGiveASignToColourAndCoverageAndNotToHits) {
    const FilmLayout layout =
        layoutOf(kNegativeWeights | 1u << kColorPlane | 1u << kCoveragePlane | 1u << kHitsPlane);
    ASSERT_EQ(layout.planes().size(), 3u);
    EXPECT_TRUE(layout.planes()[0].isSigned());
    EXPECT_TRUE(layout.planes()[1].isSigned());
    EXPECT_FALSE(layout.planes()[2].isSigned());
    EXPECT_EQ(layout.find(kCoveragePlane), 1u);
    EXPECT_EQ(parseFilmLayout(textOf(layout)), layout);
}

TEST(FilmLayout, LayersOfIdsStandAfterThePlanes) {
    for (const uint32_t ids : {kObjectIds, kMaterialIds, kObjectIds | kMaterialIds}) {
        const FilmLayout layout = layoutOf(ids | 1u << kColorPlane);
        EXPECT_EQ(layout.idLayers(), layerNames(ids));
        EXPECT_EQ(layout.words(), colorLayout().words());
        EXPECT_EQ(parseFilmLayout(textOf(layout)), layout);
        EXPECT_NE(layout, colorLayout());
    }
    EXPECT_FALSE(parseFilmLayout("color: R,G,B unsigned squares; pixel-id: ids").has_value());
    EXPECT_FALSE(parseFilmLayout("object-id: ids; color: R,G,B unsigned squares").has_value());
}

TEST(FilmLayout, ItsTextIsReadBack) {
    EXPECT_EQ(textOf(colorLayout()), "color: R,G,B unsigned squares");
    EXPECT_EQ(textOf(signedLayout()),
              "color: R,G,B unsigned squares; tilt: tilt.X,tilt.Y signed; height: height.Z signed squares");
    EXPECT_EQ(parseFilmLayout(textOf(colorLayout())), colorLayout());
    EXPECT_EQ(parseFilmLayout(textOf(signedLayout())), signedLayout());
    EXPECT_FALSE(signedLayout() == colorLayout());
    const FilmLayout depth = layoutOf(1u << kColorPlane | 1u << kHitsPlane | 1u << kDepthPlane);
    EXPECT_EQ(textOf(depth),
              "color: R,G,B unsigned squares; hits: hits.N unsigned; depth: depth.Z signed per-hit");
    EXPECT_EQ(parseFilmLayout(textOf(depth)), depth);
    EXPECT_EQ(depth.find(kDepthPlane), 2u);
    EXPECT_EQ(depth.find(kAlbedoPlane), std::nullopt);
}

TEST(FilmLayout, TextThatIsNoLayoutIsNone) {
    for (const char* text :
         {"", "color", "color: R,G,B", "color: R,G,B unsigned squares; ",
          "color: R,G,B unsigned squares more", "tilt: tilt.X signed",
          "color: R,G,B unsigned squares; a: ", "color: R,G,B unsigned squares; a: a.X,a.Y,a.Z,a.W signed",
          "color: R,G,B unsigned squares; : a signed", "color: R,G,B unsigned squares; a: R signed",
          "color: R,G,B unsigned squares; a: a.X,a.X signed",
          "color: R,G,B unsigned squares; color: a.X signed", "color: R,G,B unsigned squares; a: a,, signed",
          "color: R,G,B unsigned squares; a: a.X both"})
        EXPECT_FALSE(parseFilmLayout(text).has_value()) << text;
    std::string many = textOf(colorLayout());
    for (int i = 0; i < 32; ++i)
        many += "; a" + std::to_string(i) + ": c" + std::to_string(i) + " signed";
    EXPECT_FALSE(parseFilmLayout(many).has_value());
}

} // namespace
} // namespace lavalight
