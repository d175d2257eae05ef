// `lavalight bench rays`: its figures fit together, whatever the machine.
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/environment_variable.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using nlohmann::json;
using test::EnvironmentVariable;
using test::ProgramResult;

class Bench : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult bench(const std::vector<std::string>& options,
                                      const std::string& threads = "1") const {
        const EnvironmentVariable variable("LP_NUM_THREADS", threads);
        std::vector<std::string> words = {"bench", "rays", "cornell-box", "--rays", "1000", "--repeats", "1"};
        words.insert(words.end(), options.begin(), options.end());
        return test::runLavalight(words, folder_.path());
    }

    const test::TemporaryFolder folder_;
};

TEST_F(Bench, TellsOfEachKindOfRayWhatBothTracersDid) {
    const ProgramResult result = bench({"--json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const json report = json::parse(result.out);
    EXPECT_EQ(report.at("scene"), "cornell-box");
    EXPECT_EQ(report.at("triangles"), 32);
    EXPECT_EQ(report.at("threads"), "1");
    EXPECT_EQ(report.at("accelerator"), "bvh8");
    std::vector<std::string> kinds;
    for (const json& row : report.at("rays")) {
        kinds.push_back(row.at("kind"));
        EXPECT_GT(row.at("rays"), 500) << row; // at least half of a thousand rays hit the box
        EXPECT_GT(row.at("hitShare"), 0.0) << row;
        EXPECT_LE(row.at("hitShare"), 1.0) << row;
        EXPECT_GE(row.at("agreement"), 0.999) << row;
        EXPECT_GE(row.at("nodesPerRay"), 1.0) << row;
        EXPECT_GT(row.at("trianglesPerRay"), 0.0) << row;
        const double ours = row.at("megaraysPerSecond");
        EXPECT_GT(ours, 0.0) << row;
        EXPECT_NEAR(row.at("ratio"), ours / row.at("embreeMegaraysPerSecond").get<double>(), 1e-6) << row;
    }
    EXPECT_EQ(kinds, (std::vector<std::string>{"camera", "bounce", "shadow"}));
}

TEST_F(Bench, MeasuresTheAcceleratorThatIsNamed) {
    for (const std::string name : {"bvh16", "embree"}) {
        const ProgramResult result = bench({"--json", "--accelerator", name});
        if (result.exitCode != 0 && result.err.find("does not reach the memory") != std::string::npos)
            GTEST_SKIP() << result.err;
        ASSERT_EQ(result.exitCode, 0) << result.err;
        const json report = json::parse(result.out);
        EXPECT_EQ(report.at("accelerator"), name);
        for (const json& row : report.at("rays")) {
            EXPECT_GE(row.at("agreement"), 0.999) << row;
            EXPECT_FALSE(row.contains("nodesPerRay")) << "only kernels count";
        }
        EXPECT_NE(bench({"--accelerator", name}).out.find("accelerator " + name), std::string::npos);
    }
    EXPECT_EQ(bench({"--accelerator", "bvh9"}).exitCode, 2);
}

TEST_F(Bench, SeveralThreadsAreNoComparisonAndItSaysSo) {
    const ProgramResult result = bench({}, "2");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err,
              "lavalight: warning: LP_NUM_THREADS is 2: the ratio does not compare single threads\n");
    for (const char* kind : {"camera", "bounce", "shadow"})
        EXPECT_NE(result.out.find(kind), std::string::npos) << result.out;
}

} // namespace
} // namespace lavalight
