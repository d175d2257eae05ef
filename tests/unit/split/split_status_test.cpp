// How far a split render is, by files that a test puts into its folder.
#include <chrono>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "split/split_job.h"
#include "split/split_status.h"
#include "support/film_files.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using test::errorOf;

// A job of four parts of 16 samples each.
class SplitStatusTest : public testing::Test {
  protected:
    SplitStatusTest() {
        SplitPlan plan;
        plan.scene = "furnace";
        plan.parts = 4;
        plan.samples = {0, 64};
        writeSplitJob(plan, "furnace", folder_.path());
    }
    void finish(const std::string& part) const { write("parts/" + part + ".exr", 16); }
    // A process that renders a part: its mark and, with some samples, its checkpoint.
    void run(const std::string& process, uint32_t samples, double secondsASample = 1.0) const {
        writeFileAtomically(folder_ / ("parts/running/" + process + ".started"), std::string_view());
        write("parts/running/" + process + ".checkpoint.exr", samples, secondsASample);
    }
    void write(const std::string& name, uint32_t samples, double secondsASample = 1.0) const {
        FilmFile film = test::someFilm(1, {0, 16});
        film.progress = {samples, 0, 0};
        setValue(film.metadata, "render-seconds", std::to_string(samples * secondsASample));
        writeFilmFile(folder_ / name, film);
    }
    void age(const std::string& name, double seconds) const {
        std::filesystem::last_write_time(folder_ / name, std::filesystem::file_time_type::clock::now() -
                                                             std::chrono::seconds(static_cast<int>(seconds)));
    }
    [[nodiscard]] SplitStatus status() const { return statusOf(folder_.path()); }

    const test::TemporaryFolder folder_;
};

TEST_F(SplitStatusTest, ANewJobMissesAllItsParts) {
    EXPECT_EQ(status().parts.size(), 4u);
    EXPECT_EQ(status().count(PartState::missing), 4u);
    EXPECT_FALSE(status().secondsLeft);
}

TEST_F(SplitStatusTest, PartsAreDoneRunningStoppedOrMissing) {
    finish("part-0000");
    writeFileAtomically(folder_ / "parts/running/part-0001.node-7.example-12.started", std::string_view());
    run("part-0002.node-8-13", 4);
    age("parts/running/part-0002.node-8-13.started", 500.0);
    age("parts/running/part-0002.node-8-13.checkpoint.exr", 241.0); // three intervals of 60 s, and 60 s
    const SplitStatus now = status();
    EXPECT_EQ(now.parts[0].state, PartState::done);
    EXPECT_EQ(now.parts[1].state, PartState::running);
    EXPECT_EQ(now.parts[1].host, "node-7.example");
    EXPECT_EQ(now.parts[2].state, PartState::stopped);
    EXPECT_DOUBLE_EQ(now.parts[2].fraction, 0.25);
    EXPECT_EQ(now.parts[3].state, PartState::missing);
    age("parts/running/part-0002.node-8-13.checkpoint.exr", 200.0);
    EXPECT_EQ(status().parts[2].state, PartState::running);
}

TEST_F(SplitStatusTest, TheTimeLeftFollowsFromFinishedPartsAndThoseThatRun) {
    finish("part-0000"); // took 16 s
    run("part-0001.a-1", 8, 3.0);
    run("part-0002.b-2", 12, 3.0);
    ASSERT_TRUE(status().secondsLeft);
    EXPECT_DOUBLE_EQ(*status().secondsLeft, (0.5 + 0.25 + 1.0) * 16.0 / 2.0);
    std::filesystem::remove(folder_ /
                            "parts/part-0000.exr"); // only those that run can say how long a part takes
    EXPECT_DOUBLE_EQ(*status().secondsLeft, (1.0 + 0.5 + 0.25 + 1.0) * 48.0 / 2.0);
}

TEST_F(SplitStatusTest, TheNewestSignOfAPartCounts) {
    run("part-0001.a-1", 12);
    age("parts/running/part-0001.a-1.checkpoint.exr", 5000.0);
    age("parts/running/part-0001.a-1.started", 5000.0);
    run("part-0001.b-2", 8);
    const PartStatus part = status().parts[1];
    EXPECT_EQ(part.state, PartState::running);
    EXPECT_EQ(part.host, "b");
    EXPECT_LT(part.secondsSinceSign, 100.0);
}

TEST_F(SplitStatusTest, AnInterruptedPartHasStoppedAtOnce) {
    write("parts/running/part-0001.a-1.checkpoint.exr", 8); // its process has ended and taken its mark along
    EXPECT_EQ(status().parts[1].state, PartState::stopped);
    EXPECT_DOUBLE_EQ(status().parts[1].fraction, 0.5);
}

TEST_F(SplitStatusTest, AnEmptyFileIsNoPart) {
    writeFileAtomically(folder_ / "parts/part-0000.exr", std::string_view());
    EXPECT_EQ(status().parts[0].state, PartState::missing);
}

TEST_F(SplitStatusTest, DamagedCheckpointsSayNothing) {
    writeFileAtomically(folder_ / "parts/running/part-0001.a-1.started", std::string_view());
    writeFileAtomically(folder_ / "parts/running/part-0001.a-1.checkpoint.exr",
                        std::string_view("not an image"));
    EXPECT_EQ(status().parts[1].state, PartState::running);
    EXPECT_DOUBLE_EQ(status().parts[1].fraction, 0.0);
}

TEST_F(SplitStatusTest, TextAndJsonSayTheSame) {
    finish("part-0000");
    run("part-0001.a-1", 8);
    const std::string text = textOf(status());
    EXPECT_NE(text.find("1 of 4 parts done, 1 running, 0 stopped, 2 missing"), std::string::npos) << text;
    EXPECT_NE(text.find("part-0001  running on a, 50 %"), std::string::npos) << text;
    const auto json = nlohmann::json::parse(jsonOf(status()));
    EXPECT_EQ(json["done"], 1);
    EXPECT_EQ(json["missing"], 2);
    EXPECT_EQ(json["parts"][1]["fraction"], 0.5);
    EXPECT_DOUBLE_EQ(json["secondsLeft"], 2.5 * 16.0);
    for (const char* part : {"part-0001", "part-0002", "part-0003"})
        finish(part);
    EXPECT_NE(textOf(status()).find("all parts are done"), std::string::npos);
}

TEST_F(SplitStatusTest, OtherFoldersAreRefused) {
    const test::TemporaryFolder other;
    EXPECT_NE(errorOf([&] { static_cast<void>(statusOf(other.path())); }).find("it has no job.json"),
              std::string::npos);
    EXPECT_NE(errorOf([&] { static_cast<void>(statusOf(other / "none")); }).find("it is not a directory"),
              std::string::npos);
    writeFileAtomically(other / "job.json", std::string_view("[1"));
    EXPECT_NE(errorOf([&] {
                  static_cast<void>(statusOf(other.path()));
              }).find("it is not what lavalight split writes"),
              std::string::npos);
}

} // namespace
} // namespace lavalight
