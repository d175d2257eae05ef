// The bias ledger: whatever was on or happened that makes the image's mean differ from the scene's.
#pragma once

#include <string>
#include <vector>

#include "render/film.h"
#include "render/renderer.h"
#include "render/settings.h"
#include "scene/scene.h"

namespace lavalight {

struct LedgerEntry {
    std::string cause;  // fixed word, e.g. "cut-paths"
    std::string detail; // figures or names
};

// Empty for an unbiased image of everything that the scene asks for.
[[nodiscard]] std::vector<LedgerEntry> makeLedger(const Scene& scene, const RenderSettings& settings,
                                                  const FilmTallies& tallies, StopReason stop);

// What happened to samples: the end of the ledger.
[[nodiscard]] std::vector<LedgerEntry> tallyEntries(const FilmTallies& tallies);

// The warning that goes with overlapping solids, with the names of two of the meshes.
[[nodiscard]] std::string overlapText(const Scene& scene, const FilmTallies& tallies);

// One line for the EXR header: "none", or entries joined by "; ".
[[nodiscard]] std::string ledgerText(const std::vector<LedgerEntry>& ledger);

} // namespace lavalight
