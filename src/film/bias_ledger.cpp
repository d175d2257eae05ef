#include "film/bias_ledger.h"

#include <algorithm>

#include <fmt/format.h>

namespace lavalight {
namespace {

constexpr std::string_view kBetween = "; ";
constexpr std::string_view kBeforeDetail = ": ";
constexpr std::string_view kCauseLetters = "abcdefghijklmnopqrstuvwxyz-";

// Where the first entry ends: details may have semicolons of their own, which no cause follows.
size_t endOfEntry(std::string_view text) {
    for (size_t at = text.find(kBetween); at != std::string_view::npos; at = text.find(kBetween, at + 1)) {
        const std::string_view next = text.substr(at + kBetween.size());
        const size_t cause = next.find_first_not_of(kCauseLetters);
        if (cause != std::string_view::npos && cause > 0 && next.substr(cause).starts_with(kBeforeDetail))
            return at;
    }
    return text.size();
}

} // namespace

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
        text += fmt::format("{}{}{}{}", text.empty() ? std::string_view() : kBetween, entry.cause,
                            kBeforeDetail, entry.detail);
    return text;
}

std::vector<LedgerEntry> parseLedger(std::string_view text) {
    std::vector<LedgerEntry> ledger;
    if (text == ledgerText({}))
        return ledger;
    while (!text.empty()) {
        const size_t length = endOfEntry(text);
        const std::string_view entry = text.substr(0, length);
        const size_t colon = entry.find(kBeforeDetail);
        if (colon == std::string_view::npos)
            ledger.push_back({std::string(entry), {}});
        else
            ledger.push_back({std::string(entry.substr(0, colon)),
                              std::string(entry.substr(colon + kBeforeDetail.size()))});
        text.remove_prefix(std::min(text.size(), length + kBetween.size()));
    }
    return ledger;
}

} // namespace lavalight
