// The bias ledger: whatever was on or happened that makes the image's mean differ from the scene's.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "film/raw_film.h"

namespace lavalight {

struct LedgerEntry {
    std::string cause;  // fixed word, e.g. "cut-paths"
    std::string detail; // figures or names
};

// The entries for what happened to samples, at the end of a ledger.
[[nodiscard]] std::vector<LedgerEntry> tallyEntries(const FilmTallies& tallies);

// One line for the EXR header: "none", or entries joined by "; ".
[[nodiscard]] std::string ledgerText(const std::vector<LedgerEntry>& ledger);
// Reads such a line back.
[[nodiscard]] std::vector<LedgerEntry> parseLedger(std::string_view text);

} // namespace lavalight
