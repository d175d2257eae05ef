// The table picks with the probabilities that it states, and these are the weights'.
#include "light/alias_table.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "base/error.h"
#include "support/chi_square.h"
#include "support/random_numbers.h"

namespace lavalight::test {
namespace {

// The rule that alias_table.h states.
uint32_t pick(const std::vector<AliasEntry>& table, Random& random) {
    const uint64_t product = uint64_t{random.bits()} * table.size();
    const auto bin = static_cast<uint32_t>(product >> 32);
    const float u = static_cast<float>(static_cast<uint32_t>(product) >> 8) * 0x1p-24f;
    return u < table[bin].probability ? bin : table[bin].alias;
}

std::vector<double> spreadWeights(uint32_t count, uint32_t seed) {
    Random random(seed);
    std::vector<double> weights;
    for (uint32_t i = 0; i < count; ++i)
        weights.push_back(i % 7 == 3 ? 0.0 : std::exp(random.between(-6.0f, 6.0f)));
    return weights;
}

// The exact probability of each pick, in double, from the table's own bins.
std::vector<double> exactPmf(const std::vector<AliasEntry>& table) {
    std::vector<double> pmf(table.size(), 0.0);
    for (size_t i = 0; i < table.size(); ++i) {
        pmf[i] += double{table[i].probability} / static_cast<double>(table.size());
        pmf[table[i].alias] += (1.0 - double{table[i].probability}) / static_cast<double>(table.size());
    }
    return pmf;
}

TEST(AliasTable, PicksAsOftenAsItsPmfSays) {
    const std::vector<AliasEntry> table = buildAliasTable(spreadWeights(100, 1));
    constexpr uint32_t kPicks = 1000000;
    std::vector<uint32_t> observed(table.size(), 0);
    std::vector<double> expected;
    expected.reserve(table.size());
    Random random(2);
    for (uint32_t i = 0; i < kPicks; ++i)
        ++observed[pick(table, random)];
    for (const AliasEntry& entry : table)
        expected.push_back(double{entry.pmf} * kPicks);
    EXPECT_GT(chiSquare(observed, expected).pValue, kLeastPValue);
}

TEST(AliasTable, StatesThePmfThatItSamplesWith) {
    const std::vector<AliasEntry> table = buildAliasTable(spreadWeights(5000, 3));
    const std::vector<double> exact = exactPmf(table);
    for (size_t i = 0; i < table.size(); ++i)
        EXPECT_FLOAT_EQ(table[i].pmf, static_cast<float>(exact[i]));
}

TEST(AliasTable, DeviatesFromTheWeightsByLessThanItPromises) {
    const std::vector<double> weights = spreadWeights(20000, 4);
    const std::vector<AliasEntry> table = buildAliasTable(weights);
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto n = static_cast<double>(weights.size());
    std::vector<double> donors(table.size(), 0.0);
    for (const AliasEntry& entry : table)
        donors[entry.alias] += 1.0;
    const std::vector<double> exact = exactPmf(table);
    double total = 0.0;
    for (size_t i = 0; i < table.size(); ++i) {
        const double deviation = std::abs(exact[i] - weights[i] / sum);
        EXPECT_LE(deviation, 0x1p-24 * (1.0 + donors[i]) / n);
        total += deviation;
    }
    EXPECT_LT(total, 0x1p-23);
}

TEST(AliasTable, PmfsSumToOne) {
    double sum = 0.0;
    for (const AliasEntry& entry : buildAliasTable(spreadWeights(20000, 5)))
        sum += entry.pmf;
    EXPECT_NEAR(sum, 1.0, 1e-6);
}

TEST(AliasTable, NeverPicksAWeightOfZero) {
    for (const uint32_t count : {2u, 10u, 1000u}) {
        const std::vector<double> weights = spreadWeights(count, 6);
        const std::vector<AliasEntry> table = buildAliasTable(weights);
        for (size_t i = 0; i < count; ++i) {
            EXPECT_GT(weights[table[i].alias], 0.0);
            if (weights[i] == 0.0) {
                EXPECT_EQ(table[i].probability, 0.0f);
                EXPECT_EQ(table[i].pmf, 0.0f);
            }
        }
    }
}

TEST(AliasTable, KeepsAChanceForTheFaintestWeight) {
    const std::vector<AliasEntry> table = buildAliasTable(std::vector<double>{1e-30, 1.0, 0.0});
    EXPECT_GT(table[0].pmf, 0.0f);
    EXPECT_LT(table[0].pmf, 1e-7f);
}

TEST(AliasTable, OfOneEntryAlwaysPicksIt) {
    const std::vector<AliasEntry> table = buildAliasTable(std::vector<double>{3.0});
    EXPECT_EQ(table[0].probability, 1.0f);
    EXPECT_EQ(table[0].pmf, 1.0f);
}

TEST(AliasTable, IsEmptyWithoutAPositiveWeight) {
    EXPECT_TRUE(buildAliasTable({}).empty());
    EXPECT_TRUE(buildAliasTable(std::vector<double>{0.0, 0.0}).empty());
}

TEST(AliasTable, RefusesWeightsThatAreNoWeights) {
    for (const double bad :
         {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW((void)buildAliasTable(std::vector<double>{1.0, bad}), Error);
}

} // namespace
} // namespace lavalight::test
