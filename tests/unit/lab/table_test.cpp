// Tests of the lab's tables: ratios, and the three ways to write them.
#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "lab/table.h"

namespace lavalight::test {
namespace {

Table twoRows() {
    EstimatorRow naive{"naive", 100, 1.25, 1.5, 0.125, 8.0, {}, 1.0, {uint64_t{7}}};
    EstimatorRow dear{"half, but \"dear\"", 50, 1.75, {}, 0.25, 4.0, {}, 4.0, {Cell()}};
    Table table = estimatorTable("pair", "A pair", {naive, dear}, {{"rolls", "rolls"}});
    table.notes = {"A note."};
    return table;
}

TEST(EstimatorRow, HoldsTheMomentsAndTheTheory) {
    const EstimatorRow row = estimatorRow("dice", {3.5, 12.0, 5}, {3.25, 2.5}, 2.0);
    EXPECT_EQ(row.estimator, "dice");
    EXPECT_EQ(row.samples, 5u);
    EXPECT_EQ(row.estimate, 3.5);
    EXPECT_EQ(row.exact, 3.25);
    EXPECT_EQ(row.variance, 3.0); // 12 / (5 - 1)
    EXPECT_DOUBLE_EQ(row.standardError, std::sqrt(3.0 / 5.0));
    EXPECT_EQ(row.theory, 2.5);
    EXPECT_EQ(row.cost, 2.0);
}

TEST(LabTable, TheRatioIsVarianceTimesCostOverThatOfTheFirstRow) {
    const nlohmann::ordered_json json = tableJson(twoRows());
    EXPECT_EQ(json.at("rows").at(0).at("ratio"), 1.0);
    EXPECT_EQ(json.at("rows").at(1).at("ratio"), 2.0);
}

TEST(LabTable, ANaiveRowWithoutVarianceLeavesNoRatio) {
    const Table table =
        estimatorTable("none", "", {EstimatorRow{"exact", 1, 1.0, 1.0, 0.0, 0.0, {}, 1.0, {}}});
    EXPECT_TRUE(tableJson(table).at("rows").at(0).at("ratio").is_null());
}

TEST(LabTable, TheoryHasAColumnOnlyWhereARowHasOne) {
    EXPECT_FALSE(tableJson(twoRows()).at("rows").at(0).contains("theoryVariance"));
    const Table table = estimatorTable("t", "", {EstimatorRow{"a", 1, 1.0, {}, 0.0, 2.0, 3.0, 1.0, {}}});
    EXPECT_EQ(tableJson(table).at("rows").at(0).at("theoryVariance"), 3.0);
}

TEST(LabTable, CsvHasOneHeaderAndQuotesWhatNeedsIt) {
    const Table other = estimatorTable("other", "", {EstimatorRow{"b", 1, 0.1, {}, 0.0, 0.0, {}, 1.0, {}}});
    const std::array<Table, 2> tables{twoRows(), other};
    EXPECT_EQ(tablesCsv(tables), "table,estimator,samples,estimate,exact,standardError,variance,ratio,rolls\n"
                                 "pair,naive,100,1.25,1.5,0.125,8,1,7\n"
                                 "pair,\"half, but \"\"dear\"\"\",50,1.75,,0.25,4,2,\n"
                                 "other,b,1,0.1,,0,0,,\n");
}

TEST(LabTable, TextAlignsColumnsAndNamesWhatIsMissing) {
    EXPECT_EQ(tableText(twoRows()),
              "A pair\n\n"
              "estimator         samples  estimate  exact  std error  variance  ratio  rolls\n"
              "naive                 100      1.25    1.5      0.125         8      1      7\n"
              "half, but \"dear\"       50      1.75      -       0.25         4      2      -\n"
              "\n* A note.\n");
}

} // namespace
} // namespace lavalight::test
