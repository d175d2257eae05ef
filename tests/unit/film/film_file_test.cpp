// Film files come back as they were, and damaged ones not at all.
#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "base/file.h"
#include "support/film_files.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using test::errorOf;
using test::someFilm;
using test::TemporaryFolder;

Metadata sorted(Metadata metadata) {
    std::sort(metadata.begin(), metadata.end());
    return metadata;
}

void expectEqual(const FilmFile& a, const FilmFile& b) {
    EXPECT_EQ(a.film.width, b.film.width);
    EXPECT_EQ(a.film.height, b.film.height);
    EXPECT_EQ(a.film.words, b.film.words);
    EXPECT_EQ(a.film.tallies, b.film.tallies);
    EXPECT_EQ(a.film.layout, b.film.layout);
    EXPECT_EQ(a.ranges, b.ranges);
    EXPECT_EQ(a.progress, b.progress);
    EXPECT_EQ(sorted(a.metadata), sorted(b.metadata));
}

class FilmFiles : public testing::Test {
  protected:
    void SetUp() override { writeFilmFile(folder_ / "a.exr", film_); }
    [[nodiscard]] std::string refusalOf(const std::string& name) const {
        return errorOf([&] { (void)readFilmFile(folder_ / name); });
    }

    // This is called thousands of times, so it does not wait for the disk.
    void writeBytes(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }

    const TemporaryFolder folder_;
    FilmFile film_ = someFilm(1, {8, 24});
};

TEST_F(FilmFiles, ComeBackAsTheyWere) {
    expectEqual(readFilmFile(folder_ / "a.exr"), film_);
    film_.ranges = {{0, 4}, {8, 24}};
    film_.progress = {3, 16, 19};
    film_.film.tallies = {~uint64_t{0}, 1, 1ull << 40, 7, 6, 5, 4, 3};
    writeFilmFile(folder_ / "b.exr", film_);
    expectEqual(readFilmFile(folder_ / "b.exr"), film_);
}

TEST_F(FilmFiles, BringTheirLayersWithThem) {
    FilmFile film = someFilm(4, {0, 8}, test::signedLayout());
    film.film.words[film.film.pixels() * 24] = 0xffffff00u; // the highest word of tilt.X of a pixel
    writeFilmFile(folder_ / "b.exr", film);
    expectEqual(readFilmFile(folder_ / "b.exr"), film);
    const ExrFile image = readExr(folder_ / "b.exr");
    const Rendering expected = resolve(film.film);
    ASSERT_EQ(image.layers.size(), expected.layers.size());
    for (const Layer& layer : expected.layers) {
        const Layer* same = image.find(layer.name);
        ASSERT_NE(same, nullptr) << layer.name;
        EXPECT_EQ(same->channels, layer.channels);
        EXPECT_EQ(same->mean.pixels, layer.mean.pixels) << layer.name;
        ASSERT_EQ(same->variance.has_value(), layer.variance.has_value()) << layer.name;
        if (layer.variance) {
            EXPECT_EQ(same->variance->pixels, layer.variance->pixels) << layer.name;
        }
    }
    EXPECT_LT(image.find("tilt")->mean.pixels.front().x, 0.0f);
}

// A file from before layouts, with the tallies that there were then.
TEST_F(FilmFiles, FromBeforeThereWereLayersAreRead) {
    const FilmFile old =
        readFilmFile(std::string(LAVALIGHT_SOURCE_DIR) + "/tests/references/film-without-layout.exr");
    EXPECT_EQ(old.film.layout, colorLayout());
    EXPECT_EQ(textOf(old.ranges), "0:2");
    EXPECT_TRUE(old.isComplete());
    EXPECT_EQ(old.film.samples(), 2u * 4 * 3);
    EXPECT_EQ(old.film.tallies[kTallyNegative], 0u);
    EXPECT_GT(resolve(old.film).radiance().at(1, 1).r, 0.0f);
}

TEST_F(FilmFiles, WithALayoutOfALaterVersionAreRefusedByIt) {
    std::string bytes = readFile(folder_ / "a.exr");
    const std::string layout = textOf(colorLayout());
    const std::string other = "color: R,G,B unsigned ranking";
    ASSERT_EQ(other.size(), layout.size());
    bytes.replace(bytes.find(layout), layout.size(), other);
    writeBytes("b.exr", bytes);
    EXPECT_NE(refusalOf("b.exr").find("b.exr: its film has the layers \"" + other + "\", which this version"),
              std::string::npos)
        << refusalOf("b.exr");
}

TEST_F(FilmFiles, AreImagesForEveryoneElse) {
    const ExrFile image = readExr(folder_ / "a.exr");
    const Rendering expected = resolve(film_.film);
    EXPECT_EQ(image.radiance().pixels, expected.radiance().pixels);
    EXPECT_EQ(image.variance().pixels, expected.variance().pixels);
    EXPECT_EQ(image.sampleCounts, expected.sampleCounts);
}

// The library checks compressed blocks only, and some are stored as they are.
TEST_F(FilmFiles, ABitThatFlipsIsFoundOrChangesNothing) {
    const std::string bytes = readFile(folder_ / "a.exr");
    size_t refused = 0;
    for (size_t i = 0; i < bytes.size(); ++i) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ (1 << i % 8));
        writeBytes("b.exr", damaged);
        try {
            expectEqual(readFilmFile(folder_ / "b.exr"), film_);
        } catch (const Error& error) {
            ++refused;
            EXPECT_TRUE(std::string(error.what()).starts_with("cannot read ")) << error.what();
        }
        ASSERT_FALSE(HasFailure()) << "byte " << i << " of " << bytes.size();
    }
    EXPECT_GT(refused, bytes.size() / 2); // the rest: names and values that do not matter, RGB
}

TEST_F(FilmFiles, ThatEndEarlyAreRefused) {
    const std::string bytes = readFile(folder_ / "a.exr");
    for (size_t size = 0; size < bytes.size(); size += 7) {
        writeBytes("b.exr", bytes.substr(0, size));
        EXPECT_NE(refusalOf("b.exr"), "") << size << " bytes of " << bytes.size();
    }
}

TEST_F(FilmFiles, ImagesWithoutAFilmAreTold) {
    writeExr(folder_ / "b.exr", resolve(film_.film), film_.metadata);
    EXPECT_NE(refusalOf("b.exr").find("b.exr: it holds no exact film"), std::string::npos);
    EXPECT_NE(refusalOf("none.exr").find("no such file"), std::string::npos);
}

TEST_F(FilmFiles, WhoseHeaderContradictsItselfAreRefused) {
    for (const FilmProgress& progress :
         {FilmProgress{17, 0, 0}, FilmProgress{8, 9, 0}, FilmProgress{8, 0, 3}, FilmProgress{8, 4, 20}}) {
        film_.progress = progress;
        writeFilmFile(folder_ / "b.exr", film_);
        EXPECT_NE(refusalOf("b.exr").find("contradicts itself"), std::string::npos);
    }
}

} // namespace
} // namespace lavalight
