// What may be joined, and what is in the way where two films may not.
#include <gtest/gtest.h>

#include "film/film_identity.h"
#include "film/film_merge.h"
#include "support/film_files.h"

namespace lavalight {
namespace {

using test::errorOf;
using test::someFilm;

NamedFilm named(const std::string& name, const FilmFile& file) {
    return {name, file};
}

std::string refusalOf(const FilmFile& a, const FilmFile& b) {
    return errorOf([&] {
        NamedFilm sum = named("a.exr", a);
        join(sum, named("b.exr", b));
    });
}

TEST(FilmMerge, SamplesTalliesSecondsAndLedgerAreThoseOfBoth) {
    NamedFilm sum = named("a.exr", someFilm(1, {0, 8}));
    join(sum, named("b.exr", someFilm(2, {8, 24})));
    RawFilm expected = someFilm(1, {}).film;
    add(expected, someFilm(2, {}).film);
    const FilmFile& file = sum.file;
    EXPECT_EQ(file.film.words, expected.words);
    EXPECT_EQ(textOf(file.ranges), "0:24");
    EXPECT_TRUE(file.isComplete());
    EXPECT_EQ(valueOf(file.metadata, "option:spp"), "24");
    EXPECT_EQ(valueOf(file.metadata, "option:first-sample"), "0");
    EXPECT_EQ(valueOf(file.metadata, "render-seconds"), "3.000");
    EXPECT_EQ(valueOf(file.metadata, "bias-ledger"),
              "clamp-indirect: 5; cut-paths: 6 paths ended by --max-bounces, mean throughput 0.5; "
              "dropped-samples: 2 samples were not finite; "
              "negative-samples: 4 samples were negative, and counted as 0");
}

TEST(FilmMerge, OrderAndGroupingChangeNothing) {
    const std::vector<FilmFile> parts{someFilm(1, {0, 8}), someFilm(2, {8, 24}), someFilm(3, {40, 41})};
    NamedFilm first = named("1", parts[0]);
    join(first, named("2", parts[1]));
    join(first, named("3", parts[2]));
    NamedFilm last = named("3", parts[2]);
    join(last, named("1", parts[0]));
    NamedFilm second = named("2", parts[1]);
    join(second, last);
    EXPECT_EQ(first.file.film.words, second.file.film.words);
    EXPECT_EQ(first.file.film.tallies, second.file.film.tallies);
    EXPECT_EQ(textOf(second.file.ranges), "0:24,40:41");
    EXPECT_EQ(valueOf(first.file.metadata, "bias-ledger"), valueOf(second.file.metadata, "bias-ledger"));
}

TEST(FilmMerge, CommonSamplesAreNamed) {
    EXPECT_EQ(refusalOf(someFilm(1, {0, 8}), someFilm(2, {6, 24})),
              "cannot merge b.exr with a.exr: both hold the samples 6:8");
}

TEST(FilmMerge, WhatDiffersIsNamedWithBothValues) {
    const auto refusalWith = [](const std::string& key, const std::string& value) {
        FilmFile other = someFilm(2, {8, 16});
        setValue(other.metadata, key, value);
        return refusalOf(someFilm(1, {0, 8}), other);
    };
    EXPECT_EQ(refusalWith("option:seed", "7"),
              "cannot merge b.exr with a.exr: they differ in --seed (0 in a.exr, 7 in b.exr)");
    EXPECT_EQ(refusalWith("option:new", "1"),
              "cannot merge b.exr with a.exr: they differ in --new (none in a.exr, 1 in b.exr)");
    for (const char* key : {"version", "device", "driver"})
        EXPECT_NE(refusalWith(key, "other").find(std::string("they differ in ") + key), std::string::npos);
    EXPECT_NE(refusalWith("content:textures", "ffff0000ffff")
                  .find("textures (content 01234567 in a.exr, content ffff0000 in b.exr)"),
              std::string::npos);
    EXPECT_NE(
        refusalWith("content:accelerator", "another").find("accelerator (none in a.exr, another in b.exr)"),
        std::string::npos);
}

// A film of another commit may come of another program of the same version. Where one does not say, the
// version decides.
TEST(FilmMerge, CommitsDecideWhereBothFilmsSayOne) {
    const auto ofCommit = [](FilmFile film, const std::string& commit) {
        setValue(film.metadata, "commit", commit);
        return film;
    };
    const FilmFile first = someFilm(1, {0, 8});
    const FilmFile second = someFilm(2, {8, 16});
    EXPECT_EQ(refusalOf(ofCommit(first, "abc"), ofCommit(second, "abc-dirty")),
              "cannot merge b.exr with a.exr: they differ in commit (abc in a.exr, abc-dirty in b.exr)");
    EXPECT_EQ(refusalOf(ofCommit(first, "abc"), ofCommit(second, "abc")), "");
    EXPECT_EQ(refusalOf(first, ofCommit(second, "abc")), "");
    EXPECT_EQ(refusalOf(ofCommit(first, "abc"), second), "");
}

// Files may be renamed and moved; their content has its own keys.
TEST(FilmMerge, NamesCountOnlyWhereContentDiffers) {
    FilmFile other = someFilm(2, {8, 16});
    setValue(other.metadata, "scene", "copy.gltf");
    setValue(other.metadata, "option:env", "copy.hdr");
    EXPECT_EQ(refusalOf(someFilm(1, {0, 8}), other), "");
    setValue(other.metadata, "content:textures", "f");
    EXPECT_NE(refusalOf(someFilm(1, {0, 8}), other).find("scene (box.gltf in a.exr, copy.gltf in b.exr)"),
              std::string::npos);
}

FilmFile onMachine(FilmFile film, const std::string& processor, const std::string& device = "some device") {
    setValue(film.metadata, "processor", processor);
    setValue(film.metadata, "device", device);
    return film;
}

TEST(FilmMerge, FilmsOfOtherProcessorsAreRefusedWithARemedy) {
    const FilmFile first = onMachine(someFilm(1, {0, 8}), "A family 1");
    EXPECT_EQ(refusalOf(first, onMachine(someFilm(2, {8, 16}), "A family 1")), "");
    EXPECT_EQ(refusalOf(first, onMachine(someFilm(2, {8, 16}), "B family 2")),
              "cannot merge b.exr with a.exr: they differ in processor (A family 1 in a.exr, B family 2 in "
              "b.exr); try "
              "--statistical, which asks for equal means in place of equal bits");
    FilmFile otherSeed = onMachine(someFilm(2, {8, 16}), "B family 2");
    setValue(otherSeed.metadata, "option:seed", "7");
    EXPECT_EQ(refusalOf(first, otherSeed).find("--statistical"), std::string::npos) << "it would not help";
    NamedFilm withOlder = named("a.exr", first);
    join(withOlder, named("b.exr", someFilm(2, {8, 16}))); // films of before do not say a processor
    EXPECT_EQ(valueOf(withOlder.file.metadata, "processor"), "A family 1");
    EXPECT_EQ(valueOf(withOlder.file.metadata, "machines"), "");
    NamedFilm older = named("a.exr", someFilm(1, {0, 8}));
    join(older, named("b.exr", onMachine(someFilm(2, {8, 16}), "A family 1")));
    EXPECT_NE(errorOf([&] {
                  join(older, named("c.exr", onMachine(someFilm(3, {16, 24}), "B family 2")));
              }),
              "");
}

TEST(FilmMerge, StatisticalMergingCountsEachSampleAndNamesTheKinds) {
    NamedFilm sum = named("a.exr", onMachine(someFilm(1, {0, 8}), "A", "first"));
    const FilmFile second = onMachine(someFilm(2, {8, 24}), "B", "second");
    const FilmFile third = onMachine(someFilm(3, {24, 32}), "A", "first");
    const uint64_t ofFirst = sum.file.film.samples() + third.film.samples();
    RawFilm expected = sum.file.film;
    join(sum, named("b.exr", second), Machines::any);
    join(sum, named("c.exr", third), Machines::any);
    add(expected, second.film);
    add(expected, third.film);
    EXPECT_EQ(sum.file.film.words, expected.words);
    EXPECT_EQ(valueOf(sum.file.metadata, "processor"), "A and B");
    EXPECT_EQ(valueOf(sum.file.metadata, "device"), "first and second");
    const std::string ledger = valueOf(sum.file.metadata, "bias-ledger");
    EXPECT_NE(ledger.find("mixed-machines: " + std::to_string(ofFirst) +
                          " samples by first, some driver, A, " + std::to_string(second.film.samples()) +
                          " samples by second, some driver, B"),
              std::string::npos)
        << ledger;
    const std::string refusal = errorOf([&] {
        join(sum, named("d.exr", onMachine(someFilm(4, {32, 40}), "A", "first")));
    });
    EXPECT_NE(refusal.find("processor (A and B in a.exr, A in d.exr)"), std::string::npos) << refusal;
}

TEST(FilmMerge, StatisticalMergingOfOneKindIsOrdinary) {
    NamedFilm sum = named("a.exr", onMachine(someFilm(1, {0, 8}), "A"));
    join(sum, named("b.exr", onMachine(someFilm(2, {8, 16}), "A")), Machines::any);
    EXPECT_EQ(valueOf(sum.file.metadata, "machines"), "");
    EXPECT_EQ(valueOf(sum.file.metadata, "processor"), "A");
    EXPECT_EQ(valueOf(sum.file.metadata, "bias-ledger").find("mixed-machines"), std::string::npos);
}

TEST(FilmMerge, FilmsThatLackSamplesAreTold) {
    FilmFile part = someFilm(2, {8, 16});
    part.progress = {4, 2, 3};
    EXPECT_NE(refusalOf(someFilm(1, {0, 8}), part).find("cannot merge b.exr: its render was interrupted"),
              std::string::npos);
    EXPECT_NE(refusalOf(part, someFilm(1, {0, 8})).find("cannot merge a.exr"), std::string::npos);
}

TEST(FilmMerge, FilmsOfOtherLayersAreRefusedByTheirNames) {
    EXPECT_EQ(refusalOf(someFilm(1, {0, 8}), someFilm(2, {8, 16}, test::signedLayout())),
              "cannot merge b.exr with a.exr: they differ in layers (color: R,G,B unsigned squares in a.exr; "
              "color: R,G,B unsigned squares; tilt: tilt.X,tilt.Y signed; height: height.Z signed squares in "
              "b.exr); try to render the parts with the same layers");
    NamedFilm sum = named("a.exr", someFilm(1, {0, 8}, test::signedLayout()));
    join(sum, named("b.exr", someFilm(2, {8, 16}, test::signedLayout())));
    EXPECT_EQ(sum.file.film.layout, test::signedLayout());
    RawFilm expected = someFilm(1, {}, test::signedLayout()).film;
    add(expected, someFilm(2, {}, test::signedLayout()).film);
    EXPECT_EQ(sum.file.film.words, expected.words);
}

TEST(FilmMerge, FilmsOfOtherSizesAreRefused) {
    FilmFile other = someFilm(2, {8, 16});
    std::swap(other.film.width, other.film.height);
    EXPECT_NE(refusalOf(someFilm(1, {0, 8}), other).find("differ in size"), std::string::npos);
}

} // namespace
} // namespace lavalight
