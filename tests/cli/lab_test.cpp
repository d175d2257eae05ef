// `lavalight lab`: the experiments' figures against theory, and the ways to print them.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::runLavalight;
using test::TemporaryFolder;

const std::vector<std::string> kNames{"dice", "strata",   "hemisphere", "lights", "roulette",
                                      "mis",  "survival", "fresnel",    "sampler"};

class LabCommandTest : public testing::Test {
  protected:
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
        return runLavalight(arguments, folder_.path());
    }

    // The table of that name of an experiment.
    [[nodiscard]] json table(const std::string& experiment, const std::string& name,
                             const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"lab", experiment, "--json", "--validate"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        const json document = json::parse(result.out);
        for (const json& candidate : document.at("tables"))
            if (candidate.at("name") == name)
                return candidate;
        ADD_FAILURE() << "no table " << name;
        return {};
    }

    void expectWrongUsage(const std::vector<std::string>& arguments, const std::string& part) const {
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exitCode, 2) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    }

    const TemporaryFolder folder_;
};

// Rounding of floats leaves estimates without variance off by this much.
constexpr double kRounding = 2e-6;

void expectUnbiased(const json& row) {
    const double exact = row.at("exact").get<double>();
    EXPECT_NEAR(row.at("estimate").get<double>(), exact,
                4.0 * row.at("standardError").get<double>() + kRounding * exact)
        << row;
}

void expectTheVarianceOfTheory(const json& row) {
    const double theory = row.at("theoryVariance").get<double>();
    const double exact = row.at("exact").get<double>();
    EXPECT_NEAR(row.at("variance").get<double>(), theory, 0.05 * theory + kRounding * exact * exact) << row;
}

TEST_F(LabCommandTest, EveryRowOfDiceFinds24AndAHalfWithTheVarianceOfTheory) {
    const json dice = table("dice", "dice");
    ASSERT_EQ(dice.at("rows").size(), 5u);
    for (const json& row : dice.at("rows")) {
        EXPECT_EQ(row.at("exact"), 24.5);
        EXPECT_EQ(row.at("rolls"), dice.at("rows").at(0).at("rolls"))
            << "compared at unequal numbers of rolls";
        expectUnbiased(row);
        expectTheVarianceOfTheory(row);
    }
}

TEST_F(LabCommandTest, EveryPassOfALongEstimateCounts) { // of 16 million samples each
    const json rows = table("dice", "dice", {"--samples", "40000000"}).at("rows");
    ASSERT_EQ(rows.size(), 5u);
    for (const json& row : rows) {
        EXPECT_EQ(row.at("rolls"), 40000000) << row;
        expectUnbiased(row);
    }
}

TEST_F(LabCommandTest, DiceRowsAreTheLectures) {
    const json rows = table("dice", "dice").at("rows");
    const std::vector<double> variancesPerRoll{215.83, 522.1, 158.1, 2148.7, 142.9};
    for (size_t i = 0; i < variancesPerRoll.size(); ++i) {
        EXPECT_NEAR(rows.at(i).at("theoryVariancePerRoll").get<double>(), variancesPerRoll[i], 0.05) << i;
        const double ratio = variancesPerRoll[i] / variancesPerRoll[0];
        EXPECT_NEAR(rows.at(i).at("ratio").get<double>(), ratio, 0.05 * ratio) << i;
    }
}

TEST_F(LabCommandTest, StrataAreUnbiasedWhateverTheirProbabilities) {
    const json rows = table("strata", "strata").at("rows");
    ASSERT_EQ(rows.size(), 9u);
    for (const json& row : rows) {
        expectUnbiased(row);
        expectTheVarianceOfTheory(row);
    }
    EXPECT_LT(rows.at(4).at("ratio"), 0.01) << "64 strata by the function";
    EXPECT_LT(rows.at(5).at("ratio"), 1e-9) << "the pdf";
    EXPECT_GT(rows.at(6).at("ratio"), 1.0) << "backwards";
}

TEST_F(LabCommandTest, BothSkiesAreFoundByBothDensities) {
    for (const char* sky : {"constant", "overcast"}) {
        const json rows = table("hemisphere", sky).at("rows");
        for (const json& row : rows) {
            expectUnbiased(row);
            expectTheVarianceOfTheory(row);
        }
        EXPECT_LT(rows.at(1).at("ratio"), 0.2) << sky;
    }
}

TEST_F(LabCommandTest, LightsArePickedWithoutBias) {
    const json rows = table("lights", "spheres").at("rows");
    for (const json& row : rows) {
        expectUnbiased(row);
        expectTheVarianceOfTheory(row);
    }
}

// Means of one table's rows may differ by noise alone.
void expectOneMean(const json& rows) {
    for (const json& row : rows) {
        const double error =
            std::hypot(row.at("standardError").get<double>(), rows.at(0).at("standardError").get<double>());
        EXPECT_NEAR(row.at("estimate").get<double>(), rows.at(0).at("estimate").get<double>(), 4.0 * error)
            << row;
    }
}

TEST_F(LabCommandTest, SelectionOfLightsKeepsTheMeanOfAScene) {
    const json rows = table("lights", "scene").at("rows");
    expectOneMean(rows);
    EXPECT_LT(rows.at(1).at("ratio"), 0.9) << "by power; measured: 0.77";
}

TEST_F(LabCommandTest, RouletteKeepsThePowerUnlessItsSurvivorsAreNotMadeUpFor) {
    const json rays = table("roulette", "rays", {"--samples", "2"}).at("rows");
    expectUnbiased(rays.at(0));
    expectUnbiased(rays.at(1));
    EXPECT_EQ(rays.at(1).at("exact"), 128.0);
    EXPECT_NEAR(rays.at(2).at("estimate").get<double>(), 64.0, 0.5);
    for (const json& row : rays)
        expectTheVarianceOfTheory(row);
}

TEST_F(LabCommandTest, EveryRouletteHasTheSameMeanOnShorterPaths) {
    const json rows = table("roulette", "cornell-box", {"--samples", "32"}).at("rows");
    ASSERT_EQ(rows.size(), 7u);
    expectOneMean(rows);
    for (const json& row : rows)
        EXPECT_GT(row.at("efficiency"), 0.0);
    EXPECT_GT(rows.at(1).at("ratio"), 3.0) << "half of all paths die at each vertex; measured: 6";
    EXPECT_GT(rows.at(0).at("raysPerPath"), 2.0 * rows.at(4).at("raysPerPath").get<double>());
    EXPECT_GT(rows.at(5).at("raysPerPath"), rows.at(4).at("raysPerPath")) << "the root kills less";
    EXPECT_GT(rows.at(6).at("raysPerPath"), rows.at(5).at("raysPerPath")) << "the cube root still less";
    EXPECT_LT(rows.at(1).at("raysPerPath"), 3.0) << "1 + 1/2 + 1/4 + ...";
}

TEST_F(LabCommandTest, MisBeatsBothOfItsTechniquesAtTheSameMean) {
    const json rows = table("mis", "veach-mis", {"--samples", "64"}).at("rows");
    ASSERT_EQ(rows.size(), 4u);
    for (const size_t combined : {2u, 3u})
        for (const size_t alone : {0u, 1u})
            EXPECT_LT(rows.at(combined).at("variance"), rows.at(alone).at("variance"));
    expectOneMean(
        json::array({rows.at(2), rows.at(3)})); // the other two rows seldom see their largest samples
}

TEST_F(LabCommandTest, WeightsWithAndWithoutSurvivalHaveTheSameMean) {
    expectOneMean(table("survival", "cornell-box", {"--samples", "64"}).at("rows"));
}

TEST_F(LabCommandTest, GlassReflectsWhatTheIntegralOfItsCurveSays) {
    const json rows = table("fresnel", "reflectance", {"--samples", "2"}).at("rows");
    ASSERT_EQ(rows.size(), 4u);
    for (const json& row : rows)
        expectUnbiased(row);
    EXPECT_LT(rows.at(1).at("exact"), rows.at(0).at("exact")) << "Schlick is too low";
}

TEST_F(LabCommandTest, SobolFallsFasterOnSmoothIntegrandsAndIndependentByTheRoot) {
    const ProgramResult result = run({"lab", "sampler", "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const json tables = json::parse(result.out).at("tables");
    const json slopes = tables.back().at("rows");
    for (const json& row : slopes) {
        const std::string name = row.at("estimator");
        if (name != "disk" && name != "cornell-box") {
            EXPECT_LE(row.at("sobolSlope"), -0.9) << name;
        }
        EXPECT_NEAR(row.at("independentSlope").get<double>(), -0.5, 0.05) << name;
    }
    const json& box = tables.at(tables.size() - 2);
    ASSERT_EQ(box.at("name"), "cornell-box");
    const json last = box.at("rows").back();
    EXPECT_EQ(last.at("samples"), 256);
    EXPECT_LT(last.at("mseRatio"), 1.0 / 1.5);
    EXPECT_NEAR(last.at("sobolEstimate").get<double>() / last.at("independentEstimate").get<double>(), 1.0,
                0.01);
}

TEST_F(LabCommandTest, TheSameSeedPrintsTheSameAndAnotherOneDoesNot) {
    const std::string first = run({"lab", "dice", "--json", "--seed", "7"}).out;
    EXPECT_EQ(run({"lab", "dice", "--json", "--seed", "7"}).out, first);
    EXPECT_NE(run({"lab", "dice", "--json", "--seed", "8"}).out, first);
}

// Fields of a line; quotes are for the fields that hold commas.
std::vector<std::string> csvFields(const std::string& line) {
    std::vector<std::string> fields{""};
    bool isQuoted = false;
    for (const char c : line) {
        if (c == '"')
            isQuoted = !isQuoted;
        else if (c == ',' && !isQuoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

TEST_F(LabCommandTest, CsvHasAFieldForEachColumnInEachRow) {
    const ProgramResult result = run({"lab", "dice", "--csv", "--samples", "4096"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    std::vector<std::vector<std::string>> lines;
    for (size_t start = 0; start < result.out.size(); start = result.out.find('\n', start) + 1)
        lines.push_back(csvFields(result.out.substr(start, result.out.find('\n', start) - start)));
    ASSERT_EQ(lines.size(), 6u);
    EXPECT_EQ(lines[0][0], "table");
    const auto exact =
        static_cast<size_t>(std::find(lines[0].begin(), lines[0].end(), "exact") - lines[0].begin());
    ASSERT_LT(exact, lines[0].size());
    for (size_t i = 1; i < lines.size(); ++i) {
        EXPECT_EQ(lines[i].size(), lines[0].size()) << i;
        EXPECT_EQ(lines[i][exact], "24.5") << i;
    }
}

TEST_F(LabCommandTest, TheTextNamesEveryColumnOfTheIssue) {
    const ProgramResult result = run({"lab", "dice", "--samples", "4096"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    for (const char* word :
         {"estimator", "samples", "estimate", "exact", "std error", "variance", "ratio", "24.5"})
        EXPECT_NE(result.out.find(word), std::string::npos) << word;
}

TEST_F(LabCommandTest, WithoutAnExperimentItListsThemAll) {
    const ProgramResult result = run({"lab"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    const json list = json::parse(run({"lab", "list", "--json"}).out);
    ASSERT_EQ(list.size(), kNames.size());
    for (size_t i = 0; i < kNames.size(); ++i) {
        EXPECT_EQ(list.at(i).at("experiment"), kNames[i]);
        EXPECT_NE(result.out.find(kNames[i]), std::string::npos) << kNames[i];
    }
}

TEST_F(LabCommandTest, AnUnknownExperimentIsWrongUsageThatNamesTheKnownOnes) {
    expectWrongUsage({"lab", "diec"}, "diec");
    for (const std::string& name : kNames)
        expectWrongUsage({"lab", "diec"}, name);
}

TEST_F(LabCommandTest, WrongOptionsAreRefusedWithTheirRange) {
    expectWrongUsage({"lab", "dice", "--samples", "3"}, "--samples");
    expectWrongUsage({"lab", "dice", "--samples", "4000000000"}, "536870912");
    expectWrongUsage({"lab", "mis", "--samples", "1"}, "samples per pixel, 2 to 65536");
    expectWrongUsage({"lab", "dice", "--samples", "-1"}, "--samples");
    expectWrongUsage({"lab", "dice", "--json", "--csv"}, "--csv");
}

} // namespace
} // namespace lavalight
