// Sums of films are the films of all their samples.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "film/raw_film.h"
#include "support/film_files.h"

namespace lavalight {
namespace {

// A film of one pixel without samples.
RawFilm emptyFilm() {
    return {1, 1, std::vector<uint32_t>(colorLayout().words(), 0), {}};
}

// Places of the first words of green's sum and of its sum of squares.
constexpr uint32_t kGreen = kSumWords + kSquareWords;
constexpr uint32_t kGreenSquare = kGreen + kSumWords;
const uint32_t kCountWord = colorLayout().countWord();

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
    a.words[kCountWord] = 3;
    a.tallies = {1, 0, 2, 65536, 5, 3, 7, 1};
    RawFilm b = emptyFilm();
    b.words[kCountWord] = 4;
    b.tallies = {10, 0, 2, 3 * 65536, 6, 2, 70, 10};
    add(a, b);
    EXPECT_EQ(a.words[kCountWord], 7u);
    const FilmTallies tallies = readable(a.tallies);
    EXPECT_EQ(tallies.droppedSamples, 11u);
    EXPECT_EQ(tallies.cutPaths, 4u);
    EXPECT_EQ(tallies.cutThroughput, 1.0); // the mean of both, by their paths
    EXPECT_EQ(tallies.crowdedPaths, 11u);
    EXPECT_EQ(tallies.crowdedSolid, 3u); // one of them
    EXPECT_EQ(tallies.negativeSamples, 77u);
    EXPECT_EQ(tallies.limitedValues, 11u);
}

TEST(RawFilm, ItsImageIsThatOfItsSums) {
    RawFilm film = emptyFilm();
    film.words[kCountWord] = 2;
    film.words[kGreen + 1] = 1u << 18; // 2^(32 + 18 - 48) = 4
    film.words[kGreenSquare + 2] = 10; // 10 * 2^(64 - 64)
    const Rendering image = resolve(film);
    EXPECT_EQ(image.sampleCounts.front(), 2u);
    EXPECT_EQ(image.radiance().pixels.front(), glm::vec3(0.0f, 2.0f, 0.0f));
    EXPECT_EQ(image.variance().pixels.front(), glm::vec3(0.0f, 1.0f, 0.0f)); // (10 / 2 - 4) / (2 - 1)
}

// Places of the first words of the sums of tilt.X and height.Z in test::signedLayout(), for a film of one
// pixel.
constexpr uint32_t kTilt = 21;
constexpr uint32_t kHeight = kTilt + 2 * kSignedSumWords;
constexpr uint32_t kHeightSquare = kHeight + kSignedSumWords;

RawFilm signedFilm(uint32_t count) {
    const FilmLayout layout = test::signedLayout();
    RawFilm film{1, 1, std::vector<uint32_t>(layout.words(), 0), {}, layout};
    film.words[layout.countWord()] = count;
    return film;
}

void setWords(RawFilm& film, uint32_t first, std::array<uint32_t, kSignedSumWords> words) {
    std::copy(words.begin(), words.end(), film.words.begin() + first);
}

// The sum of tilt.X.
std::array<uint32_t, kSignedSumWords> tiltOf(const RawFilm& film) {
    std::array<uint32_t, kSignedSumWords> words;
    std::copy_n(film.words.begin() + kTilt, kSignedSumWords, words.begin());
    return words;
}

constexpr std::array<uint32_t, 4> kMinusOneUnit{0xffffffffu, 0xffffffffu, 0xffffffffu, 0xffffffffu};
constexpr std::array<uint32_t, 4> kMinusOne{0, 0xffff0000u, 0xffffffffu, 0xffffffffu}; // -2^48 units

TEST(RawFilm, NegativeSumsCancelPositiveOnesWhateverTheOrder) {
    RawFilm minus = signedFilm(1);
    setWords(minus, kTilt, kMinusOneUnit);
    RawFilm plus = signedFilm(1);
    setWords(plus, kTilt, {0, 0, 1, 0}); // borrows from word to word
    RawFilm sum = minus;
    add(sum, plus);
    EXPECT_EQ(tiltOf(sum), (std::array<uint32_t, 4>{0xffffffffu, 0xffffffffu, 0, 0}));
    add(plus, minus);
    EXPECT_EQ(sum.words, plus.words);
    add(minus, signedFilm(1)); // -1 + 0
    EXPECT_EQ(tiltOf(minus), kMinusOneUnit);
    RawFilm twice = minus;
    add(twice, minus);
    EXPECT_EQ(tiltOf(twice), (std::array<uint32_t, 4>{0xfffffffeu, 0xffffffffu, 0xffffffffu, 0xffffffffu}));
    EXPECT_EQ(twice.tallies[kTallySaturated], 0u) << "all ones is -1 there, not the largest sum";
}

TEST(RawFilm, NegativeSumsKeepToTheirOwnPlane) {
    RawFilm film = signedFilm(1);
    setWords(film, kTilt, kMinusOneUnit);
    RawFilm sum = film;
    add(sum, film);
    for (uint32_t word = 0; word < film.words.size(); ++word)
        if (word < kTilt || word >= kTilt + kSignedSumWords) {
            EXPECT_EQ(sum.words[word], 2 * film.words[word]) << word;
        }
}

TEST(RawFilm, ASumOfSquaresBesideASignedSumSaturates) {
    RawFilm film = signedFilm(1);
    setWords(film, kHeightSquare, {0, 0, 0, 0x80000000u});
    RawFilm sum = film;
    add(sum, film);
    for (uint32_t word = 0; word < kSquareWords; ++word)
        EXPECT_EQ(sum.words[kHeightSquare + word], 0xffffffffu);
    EXPECT_EQ(sum.tallies[kTallySaturated], 1u);
}

TEST(RawFilm, LayersAreTheMeansOfTheirPlanes) {
    RawFilm film = signedFilm(2);
    setWords(film, kTilt, kMinusOne);
    setWords(film, kHeight, {0, 0xfffe0000u, 0xffffffffu, 0xffffffffu}); // -2
    setWords(film, kHeightSquare, {0, 0, 10, 0});
    const Rendering image = resolve(film);
    ASSERT_EQ(image.layers.size(), 3u);
    EXPECT_EQ(image.radiance().pixels.front(), glm::vec3(0.0f));
    const Layer& tilt = *image.find("tilt");
    EXPECT_EQ(tilt.mean.pixels.front(), glm::vec3(-0.5f, 0.0f, 0.0f));
    EXPECT_FALSE(tilt.variance.has_value()) << "it has no squares";
    const Layer& height = *image.find("height");
    EXPECT_EQ(height.channels, std::vector<std::string>{"height.Z"});
    EXPECT_EQ(height.mean.pixels.front(), glm::vec3(-1.0f, 0.0f, 0.0f));
    EXPECT_EQ(height.variance.value().pixels.front(), glm::vec3(4.0f, 0.0f, 0.0f)); // (10 / 2 - 1) / (2 - 1)
    EXPECT_EQ(image.find("depth"), nullptr);
}

} // namespace
} // namespace lavalight
