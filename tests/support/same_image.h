// Whether two film files hold the same image, bit for bit.
#pragma once

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "film/film_file.h"

namespace lavalight::test {

// All channels of all pixels, ids, tallies, ranges, and every key of the header but the time it took.
inline void expectSameImage(const std::filesystem::path& a, const std::filesystem::path& b) {
    SCOPED_TRACE(a.filename().string() + " and " + b.filename().string());
    const ExrFile imageA = readExr(a);
    const ExrFile imageB = readExr(b);
    EXPECT_TRUE(imageA.radiance().pixels == imageB.radiance().pixels);
    EXPECT_TRUE(imageA.variance().pixels == imageB.variance().pixels);
    EXPECT_TRUE(imageA.sampleCounts == imageB.sampleCounts);
    FilmFile filmA = readFilmFile(a);
    FilmFile filmB = readFilmFile(b);
    EXPECT_TRUE(filmA.film.words == filmB.film.words);
    ASSERT_EQ(filmA.film.ids.size(), filmB.film.ids.size());
    for (size_t layer = 0; layer < filmA.film.ids.size(); ++layer)
        for (size_t pixel = 0; pixel < filmA.film.pixels(); ++pixel)
            EXPECT_EQ(filmA.film.ids[layer].counts.ranked(pixel), filmB.film.ids[layer].counts.ranked(pixel));
    EXPECT_EQ(filmA.film.tallies, filmB.film.tallies);
    EXPECT_EQ(filmA.ranges, filmB.ranges);
    EXPECT_EQ(filmA.progress, filmB.progress);
    for (FilmFile* film : {&filmA, &filmB}) {
        setValue(film->metadata, "render-seconds", "");
        std::sort(film->metadata.begin(), film->metadata.end());
    }
    EXPECT_EQ(filmA.metadata, filmB.metadata);
}

} // namespace lavalight::test
