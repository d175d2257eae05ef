#include "film/bias_ledger.h"

#include <fmt/format.h>

namespace lavalight {

std::vector<LedgerEntry> tallyEntries(const FilmTallies& tallies) {
    std::vector<LedgerEntry> ledger;
    if (tallies.cutPaths > 0)
        ledger.push_back({"cut-paths", fmt::format("{} paths ended by --max-bounces, mean throughput {:.4g}",
                                                   tallies.cutPaths, tallies.cutThroughput)});
    if (tallies.crowdedPaths > 0)
        ledger.push_back({"crowded-solids", fmt::format("{} paths were within more than {} solids at once",
                                                        tallies.crowdedPaths, kMostNestedSolids)});
    if (tallies.droppedSamples > 0)
        ledger.push_back(
            {"dropped-samples", fmt::format("{} samples were not finite", tallies.droppedSamples)});
    if (tallies.negativeSamples > 0)
        ledger.push_back({"negative-samples", fmt::format("{} samples were negative, and counted as 0",
                                                          tallies.negativeSamples)});
    if (tallies.limitedValues > 0)
        ledger.push_back(
            {"limited-values",
             fmt::format("{} values of layers were limited to the film's range", tallies.limitedValues)});
    if (tallies.saturatedSums > 0)
        ledger.push_back(
            {"saturated-sums", fmt::format("{} sums left the film's range", tallies.saturatedSums)});
    return ledger;
}

std::string ledgerText(const std::vector<LedgerEntry>& ledger) {
    if (ledger.empty())
        return "none";
    std::string text;
    for (const LedgerEntry& entry : ledger)
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", entry.cause, entry.detail);
    return text;
}

} // namespace lavalight
