// Films that travel as bytes arrive as they were, and damaged ones not at all.
#include <gtest/gtest.h>

#include "film/film_bytes.h"
#include "support/film_files.h"

namespace lavalight {
namespace {

using test::errorOf;
using test::someFilm;

std::string refusalOf(const std::string& bytes) {
    return errorOf([&] { (void)filmFromBytes(bytes, "part 3"); });
}

TEST(FilmBytes, FilmsComeBackWithTheirHeader) {
    for (const FilmLayout& layout : {colorLayout(), test::signedLayout()}) {
        const FilmFile film = someFilm(1, {8, 24}, layout);
        const FilmFile back = filmFromBytes(filmBytes(film), "part 3");
        EXPECT_EQ(back.film.words, film.film.words);
        EXPECT_EQ(back.film.tallies, film.film.tallies);
        EXPECT_EQ(back.film.layout, film.film.layout);
        EXPECT_EQ(back.ranges, film.ranges);
        EXPECT_EQ(back.progress, film.progress);
        EXPECT_EQ(back.metadata, film.metadata);
    }
}

TEST(FilmBytes, IdsAndWindowsComeBack) {
    FilmFile film = someFilm(1, {0, 8}, layoutOf(1u << kColorPlane | kObjectIds));
    film.film.ids = emptyIds(film.film.layout, film.film.pixels());
    film.film.ids.front().counts.add(3, 7, 5);
    film.film.ids.front().counts.add(3, 9, 3);
    film.part = FilmPart{{10, 8}, {{2, 1, 5, 4}}};
    const FilmFile back = filmFromBytes(filmBytes(film), "part 3");
    EXPECT_EQ(back.part, film.part);
    ASSERT_EQ(back.film.ids.size(), 1u);
    const std::vector<IdCount> ranked = back.film.ids.front().counts.ranked(3);
    ASSERT_EQ(ranked.size(), 2u);
    EXPECT_EQ(ranked[0].id, 7u);
    EXPECT_EQ(ranked[1].count, 3u);
}

TEST(FilmBytes, PlanesWhosePixelsAreAlikeTakeNoRoom) {
    FilmFile film = someFilm(1, {0, 8});
    const size_t noise = filmBytes(film).size();
    for (uint32_t& word : film.film.words)
        word = 8;
    EXPECT_LT(filmBytes(film).size() + film.film.words.size() * 3, noise);
    EXPECT_EQ(filmFromBytes(filmBytes(film), "part 3").film.words, film.film.words);
}

TEST(FilmBytes, EveryBitOfDamageIsNoticed) {
    const std::string bytes = filmBytes(someFilm(1, {0, 8}));
    for (size_t at = 0; at < bytes.size(); ++at) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 4);
        EXPECT_TRUE(refusalOf(damaged).starts_with("cannot read part 3: ")) << at;
    }
}

TEST(FilmBytes, EveryCutIsNoticed) {
    const std::string bytes = filmBytes(someFilm(1, {0, 8}));
    for (size_t length = 0; length < bytes.size(); ++length)
        EXPECT_TRUE(refusalOf(bytes.substr(0, length)).starts_with("cannot read part 3: ")) << length;
    EXPECT_EQ(refusalOf(bytes + "x"), "cannot read part 3: more follows than belongs to it");
}

} // namespace
} // namespace lavalight
