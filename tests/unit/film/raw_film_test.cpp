// Sums of films are the films of all their samples.
#include <cmath>

#include <gtest/gtest.h>

#include "film/raw_film.h"

namespace lavalight {
namespace {

// One pixel. Words of a channel's sum and square by their places.
RawFilm emptyFilm() {
    return {1, 1, std::vector<uint32_t>(kFilmWords, 0), {}};
}

constexpr uint32_t kGreen = kChannelWords;
constexpr uint32_t kGreenSquare = kChannelWords + kSumWords;

TEST(RawFilm, CarriesGoFromWordToWord) {
    RawFilm a = emptyFilm();
    a.words[kGreen] = 0xffffffffu;
    a.words[kGreen + 1] = 0xffffffffu;
    RawFilm b = emptyFilm();
    b.words[kGreen] = 2;
    add(a, b);
    EXPECT_EQ(a.words[kGreen], 1u);
    EXPECT_EQ(a.words[kGreen + 1], 0u);
    EXPECT_EQ(a.words[kGreen + 2], 1u);
    EXPECT_EQ(a.words[kGreenSquare], 0u) << "the next number";
    EXPECT_EQ(a.tallies[kTallySaturated], 0u);
}

TEST(RawFilm, SumsBeyondTheRangeStayAtTheLargestValueInAnyOrder) {
    RawFilm half = emptyFilm();
    for (uint32_t word = 0; word < kSquareWords; ++word)
        half.words[kGreenSquare + word] = 0x90000000u;
    RawFilm one = emptyFilm();
    one.words[kGreenSquare] = 1;
    RawFilm first = half;
    add(first, half);
    add(first, one);
    RawFilm second = half;
    add(second, one);
    add(second, half);
    EXPECT_EQ(first.words, second.words);
    for (uint32_t word = 0; word < kSquareWords; ++word)
        EXPECT_EQ(first.words[kGreenSquare + word], 0xffffffffu);
    EXPECT_EQ(first.tallies[kTallySaturated], 1u);
    EXPECT_EQ(second.tallies[kTallySaturated], 1u);
}

TEST(RawFilm, ASumSaturatedInBothFilmsIsOneSum) {
    RawFilm film = emptyFilm();
    for (uint32_t word = 0; word < kSumWords; ++word)
        film.words[kGreen + word] = 0xffffffffu;
    film.tallies[kTallySaturated] = 1;
    RawFilm sum = film;
    add(sum, film);
    EXPECT_EQ(sum.tallies[kTallySaturated], 1u);
}

TEST(RawFilm, CountsAndTalliesAddUp) {
    RawFilm a = emptyFilm();
    a.words[kCountPlane] = 3;
    a.tallies = {1, 0, 2, 65536, 5, 0x20003};
    RawFilm b = emptyFilm();
    b.words[kCountPlane] = 4;
    b.tallies = {10, 0, 2, 3 * 65536, 6, 0x20001};
    add(a, b);
    EXPECT_EQ(a.words[kCountPlane], 7u);
    const FilmTallies tallies = readable(a.tallies);
    EXPECT_EQ(tallies.droppedSamples, 11u);
    EXPECT_EQ(tallies.cutPaths, 4u);
    EXPECT_EQ(tallies.cutThroughput, 1.0); // the mean of both, by their paths
    EXPECT_EQ(tallies.overlaps, 11u);
    EXPECT_EQ(tallies.overlapping, (std::array<uint32_t, 2>{2, 3})); // one pair of them
}

TEST(RawFilm, ItsImageIsThatOfItsSums) {
    RawFilm film = emptyFilm();
    film.words[kCountPlane] = 2;
    film.words[kGreen + 1] = 1u << 18; // 2^(32 + 18 - 48) = 4
    film.words[kGreenSquare + 2] = 10; // 10 * 2^(64 - 64)
    const Rendering image = resolve(film);
    EXPECT_EQ(image.sampleCounts.front(), 2u);
    EXPECT_EQ(image.radiance.pixels.front(), glm::vec3(0.0f, 2.0f, 0.0f));
    EXPECT_EQ(image.variance.pixels.front(), glm::vec3(0.0f, 1.0f, 0.0f)); // (10 / 2 - 4) / (2 - 1)
}

} // namespace
} // namespace lavalight
