// Alias tables.
// Based on: Vose, "A Linear Algorithm for Generating Random Numbers with a Given Distribution", 1991.
#include "light/alias_table.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/log.h"

namespace lavalight {

namespace {

constexpr double kSteps = 16777216.0; // values of u: 2^24
constexpr size_t kMaxEntries = 1u << 24;

double checkedSum(std::span<const double> weights) {
    if (weights.size() > kMaxEntries)
        throw Error(fmt::format("cannot build an alias table of {} entries: the limit is {}", weights.size(),
                                kMaxEntries));
    double sum = 0.0;
    for (size_t i = 0; i < weights.size(); ++i) {
        if (!(weights[i] >= 0.0))
            throw Error(fmt::format("cannot build an alias table: weight {} is {}", i, weights[i]));
        sum += weights[i];
    }
    if (!std::isfinite(sum))
        throw Error("cannot build an alias table: the weights' sum is not finite");
    return sum;
}

// Rounds to a multiple of 2^-24: not to 0 for a positive weight, which would lose its light.
float quantised(double probability) {
    return static_cast<float>(std::clamp(std::round(probability * kSteps), 1.0, kSteps) / kSteps);
}

// Vose's pairing: each bin that is less than full is topped up by one that is more than full.
void pairBins(std::span<const double> weights, double sum, std::vector<AliasEntry>& table) {
    const auto count = static_cast<uint32_t>(weights.size());
    std::vector<double> fill(count);
    std::vector<uint32_t> small, large;
    for (uint32_t i = 0; i < count; ++i) {
        fill[i] = weights[i] / sum * count;
        (fill[i] < 1.0 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const uint32_t poor = small.back();
        const uint32_t rich = large.back();
        small.pop_back();
        table[poor] = {weights[poor] > 0.0 ? quantised(fill[poor]) : 0.0f, rich, 0.0f};
        fill[rich] -= 1.0 - fill[poor];
        if (fill[rich] < 1.0) {
            large.pop_back();
            small.push_back(rich);
        }
    }
    // What is left over is full but for rounding, except for weights of 0, which must not profit from it.
    const auto heaviest =
        static_cast<uint32_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
    for (const std::vector<uint32_t>* rest : {&small, &large})
        for (const uint32_t i : *rest)
            table[i] = weights[i] > 0.0 ? AliasEntry{1.0f, i, 0.0f} : AliasEntry{0.0f, heaviest, 0.0f};
}

} // namespace

std::vector<AliasEntry> buildAliasTable(std::span<const double> weights) {
    const double sum = checkedSum(weights);
    if (sum <= 0.0)
        return {};
    std::vector<AliasEntry> table(weights.size());
    pairBins(weights, sum, table);
    std::vector<double> pmf(table.size(), 0.0);
    for (size_t i = 0; i < table.size(); ++i) {
        pmf[i] += table[i].probability;
        pmf[table[i].alias] += 1.0 - double{table[i].probability};
    }
    for (size_t i = 0; i < table.size(); ++i)
        table[i].pmf = static_cast<float>(pmf[i] / static_cast<double>(table.size()));
    return table;
}

} // namespace lavalight
