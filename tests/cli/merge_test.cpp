// `lavalight merge` and render --samples: the bits of one render, or a line that says what is in the way.
#include <algorithm>
#include <map>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "support/film_files.h"
#include "support/run_program.h"
#include "support/same_image.h"
#include "support/spawn.h"
#include "support/temporary_folder.h"
#include "unit/gltf/builder.h"

namespace lavalight {
namespace {

using test::expectSameImage;
using test::GltfBuilder;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

class Merge : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
        return runLavalight(arguments, folder_.path());
    }
    void render(const std::string& samples, const std::string& file,
                const std::vector<std::string>& more = {}, const std::string& scene = "cornell-box") const {
        std::vector<std::string> arguments{"render", scene,     "--size", size_, "--samples",
                                           samples,  "--quiet", "-o",     file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramResult result = run(arguments);
        ASSERT_EQ(result.exitCode, 0) << result.err;
    }
    void merge(std::vector<std::string> parts, const std::string& file) const {
        parts.insert(parts.begin(), "merge");
        parts.insert(parts.end(), {"-o", file});
        const ProgramResult result = run(parts);
        ASSERT_EQ(result.exitCode, 0) << result.err;
    }
    void expectRefusal(const std::vector<std::string>& arguments, int exitCode,
                       const std::string& part) const {
        const long filesBefore = folder_.count();
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exitCode, exitCode) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_EQ(folder_.count(), filesBefore) << "a file was left behind";
    }
    void expectUnmergeable(const std::string& a, const std::string& b, const std::string& part) const {
        expectRefusal({"merge", a, b, "-o", "out.exr"}, kFailed, part);
    }
    [[nodiscard]] std::filesystem::path at(const std::string& name) const { return folder_ / name; }

    const TemporaryFolder folder_;
    std::string size_ = "20x15";
};

TEST_F(Merge, PartsHaveTheBitsOfOneRender) {
    // Paths that are cut, so that the ledger has something to add up.
    const std::vector<std::string> cut{"--max-bounces", "2"};
    render("0:20", "whole.exr", cut);
    render("0:3", "a.exr", cut);
    render("3:16", "b.exr", {"--max-bounces", "2", "--wave-size", "1000", "--band-rows", "4"});
    render("16:20", "c.exr", cut);
    merge({"a.exr", "b.exr", "c.exr"}, "abc.exr");
    expectSameImage(at("abc.exr"), at("whole.exr"));
    merge({"c.exr", "a.exr"}, "ca.exr");
    EXPECT_EQ(textOf(readFilmFile(at("ca.exr")).ranges), "0:3,16:20");
    merge({"b.exr", "ca.exr"}, "bca.exr");
    expectSameImage(at("bca.exr"), at("whole.exr"));
    EXPECT_NE(valueOf(readExr(at("bca.exr")).metadata, "bias-ledger").find("cut-paths"), std::string::npos);
}

TEST_F(Merge, OtherSamplersAndSchedulesTheSame) {
    const std::vector<std::string> other{"--sampler", "independent", "--schedule", "wavefront"};
    render("5:12", "whole.exr", other, "cornell-glass");
    render("5:6", "a.exr", other, "cornell-glass");
    render("6:12", "b.exr", other, "cornell-glass");
    merge({"b.exr", "a.exr"}, "ba.exr");
    expectSameImage(at("ba.exr"), at("whole.exr"));
}

TEST_F(Merge, IdsAndCryptomattesAreThoseOfOneRender) {
    const std::vector<std::string> layers{"--aov", "object-id,cryptomatte,indirect", "--filter", "mitchell"};
    render("0:12", "whole.exr", layers, "cornell-glass");
    render("0:5", "a.exr", layers, "cornell-glass");
    render("5:12", "b.exr", layers, "cornell-glass");
    merge({"b.exr", "a.exr"}, "ba.exr");
    expectSameImage(at("ba.exr"), at("whole.exr"));
    EXPECT_EQ(readFilmFile(at("ba.exr")).film.ids.size(), 2u);
    render("5:12", "other.exr", {"--aov", "indirect", "--filter", "mitchell"}, "cornell-glass");
    expectUnmergeable("a.exr", "other.exr", "--aov");
}

TEST_F(Merge, SamplesFromZeroAreThoseOfAnOrdinaryRender) {
    render("0:4", "a.exr");
    const ProgramResult result = run({"render", "--size", "20x15", "--spp", "4", "--quiet", "-o", "b.exr"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(readExr(at("a.exr")).radiance().pixels, readExr(at("b.exr")).radiance().pixels);
    expectUnmergeable("a.exr", "b.exr", "b.exr: it holds no exact film");
}

TEST_F(Merge, GapsAreToldAndRecorded) {
    render("0:2", "a.exr");
    render("4:6", "b.exr");
    const ProgramResult result = run({"merge", "a.exr", "b.exr", "-o", "ab.exr"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_NE(result.err.find("0:2,4:6"), std::string::npos) << result.err;
    EXPECT_NE(result.out.find("0:2,4:6"), std::string::npos) << result.out;
    EXPECT_EQ(valueOf(readExr(at("ab.exr")).metadata, "option:spp"), "4");
}

TEST_F(Merge, RefusesWhatIsNotOfOneImage) {
    render("0:2", "a.exr");
    render("1:3", "overlap.exr");
    expectUnmergeable("a.exr", "overlap.exr", "both hold the samples 1:2");
    expectUnmergeable("a.exr", "a.exr", "both hold the samples 0:2");
    render("2:4", "seed.exr", {"--seed", "1"});
    expectUnmergeable("a.exr", "seed.exr", "--seed (0 in a.exr, 1 in seed.exr)");
    render("2:4", "schedule.exr", {"--schedule", "wavefront"});
    expectUnmergeable("a.exr", "schedule.exr", "--schedule (hosted in a.exr, wavefront in schedule.exr)");
    render("2:4", "scene.exr", {}, "cornell-glass");
    expectUnmergeable("a.exr", "scene.exr", "scene (cornell-box in a.exr, cornell-glass in scene.exr)");
    render("2:4", "view.exr", {"--fov", "30"});
    expectUnmergeable("a.exr", "view.exr", "--fov (none in a.exr, 30 in view.exr)");
    render("2:4", "env.exr", {"--env", "1,1,1"});
    expectUnmergeable("a.exr", "env.exr", "--env (none in a.exr, 1,1,1 in env.exr)");
    size_ = "20x16";
    render("2:4", "size.exr");
    expectUnmergeable("a.exr", "size.exr", "--size (20x15 in a.exr, 20x16 in size.exr)");
}

TEST_F(Merge, RefusesWhatIsNoFilm) {
    render("0:2", "a.exr");
    expectUnmergeable("a.exr", "none.exr", "none.exr: no such file");
    writeFileAtomically(at("text.exr"), "This is a text.\n");
    expectUnmergeable("a.exr", "text.exr", "text.exr");
    const std::string bytes = readFile(at("a.exr"));
    writeFileAtomically(at("cut.exr"), bytes.substr(0, bytes.size() / 2));
    expectUnmergeable("a.exr", "cut.exr", "cut.exr");
    expectRefusal({"merge", "a.exr", "a.exr", "-o", "none/out.exr"}, kFailed, "none/out.exr");
}

// A scene of the same name with another picture, buffer or number in it is another scene; the same scene
// under another name is not.
TEST_F(Merge, WhatASceneHoldsCountsAndNotItsName) {
    GltfBuilder gltf;
    gltf.addNode({{"mesh", gltf.addTriangle()}});
    gltf.json["scenes"] = {{{"nodes", {0}}}};
    gltf.json["scene"] = 0;
    writeFileAtomically(at("a.glb"), gltf.glb());
    writeFileAtomically(at("b.glb"), gltf.glb());
    render("0:2", "a.exr", {}, "a.glb");
    render("2:4", "b.exr", {}, "b.glb");
    merge({"a.exr", "b.exr"}, "ab.exr");
    float x = 0.25f;
    gltf.bytes.replace(0, sizeof x, reinterpret_cast<const char*>(&x), sizeof x);
    writeFileAtomically(at("a.glb"), gltf.glb());
    render("2:4", "c.exr", {"--look-from", "0,0,5", "--look-at", "0,0,0"}, "b.glb");
    render("4:6", "d.exr", {"--look-from", "0,0,5", "--look-at", "0,0,0"}, "a.glb");
    expectUnmergeable("c.exr", "d.exr", "geometry (content ");
}

TEST_F(Merge, KindsOfMachineAreJoinedOnlyWhenAsked) {
    render("0:2", "a.exr");
    render("2:4", "b.exr");
    FilmFile other = readFilmFile(at("b.exr"));
    setValue(other.metadata, "processor", "another");
    writeFilmFile(at("b.exr"), other);
    expectUnmergeable("a.exr", "b.exr", "try --statistical");
    const ProgramResult result = run({"merge", "--statistical", "a.exr", "b.exr", "-o", "ab.exr"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("mixed-machines: 600 samples by "), std::string::npos) << result.out;
    render("0:4", "whole.exr");
    EXPECT_EQ(readFilmFile(at("ab.exr")).film.words, readFilmFile(at("whole.exr")).film.words);
}

// A film of one sample of many pixels.
FilmFile sampleOfMany(uint32_t sample) {
    constexpr uint32_t kSide = 96;
    FilmFile film = test::someFilm(1, {sample, sample + 1});
    film.film.width = film.film.height = kSide;
    film.film.words.assign(film.film.layout.words() * film.film.pixels(), 1);
    return film;
}

// The most memory that a merge of so many parts took, in kilobytes.
long peakOfMerge(const std::filesystem::path& folder, uint32_t parts) {
    std::vector<std::string> words{LAVALIGHT_BINARY, "merge", "-o", "whole.exr"};
    for (uint32_t i = 0; i < parts; ++i)
        words.push_back("part" + std::to_string(i) + ".exr");
    test::Spawn merge;
    merge.workIn(folder.string());
    merge.open(STDOUT_FILENO, "/dev/null", O_WRONLY);
    const pid_t process = merge.start(words);
    int status = -1;
    rusage usage{};
    EXPECT_EQ(::wait4(process, &status, 0, &usage), process);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    return usage.ru_maxrss;
}

TEST_F(Merge, MemoryDoesNotGrowWithTheNumberOfParts) {
    constexpr uint32_t kFew = 40;
    constexpr uint32_t kMany = 400;
    for (uint32_t i = 0; i < kMany; ++i)
        writeFilmFile(at("part" + std::to_string(i) + ".exr"), sampleOfMany(i));
    const long few = peakOfMerge(folder_.path(), kFew);
    const long many = peakOfMerge(folder_.path(), kMany);
    const size_t film = sampleOfMany(0).film.words.size() * sizeof(uint32_t) / 1024;
    EXPECT_LT(many - few, static_cast<long>((kMany - kFew) * film / 20)) << few << " kB, then " << many;
    EXPECT_EQ(textOf(readFilmFile(at("whole.exr")).ranges), "0:400");
}

TEST_F(Merge, UsageThatCannotBeMeant) {
    render("0:2", "a.exr");
    expectRefusal({"merge", "a.exr", "-o", "out.exr"}, kWrongUsage, "give two or more");
    expectRefusal({"merge", "a.exr", "a.exr"}, kWrongUsage, "--output");
    expectRefusal({"merge", "-o", "out.exr"}, kWrongUsage, "parts");
    for (const char* samples : {"1", "2:1", "1:1", "a:b", "-1:2", "0:4,8:12", "0:4294967296"})
        expectRefusal({"render", std::string("--samples=") + samples}, kWrongUsage, "--samples");
    for (const char* option : {"--spp", "--time", "--target-error"})
        expectRefusal({"render", "--samples", "0:2", option, "1"}, kWrongUsage, option);
}

} // namespace
} // namespace lavalight
