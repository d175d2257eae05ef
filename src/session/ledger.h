// What a render writes into its bias ledger (film/bias_ledger.h).
#pragma once

#include <string>
#include <vector>

#include "film/bias_ledger.h"
#include "film/raw_film.h"
#include "film/stop_reason.h"
#include "render/settings.h"
#include "scene/scene.h"

namespace lavalight {

// The ledger's entries; none for an unbiased image of everything that the scene asks for.
[[nodiscard]] std::vector<LedgerEntry> makeLedger(const Scene& scene, const RenderSettings& settings,
                                                  const FilmTallies& tallies, StopReason stop);

// The warning that goes with more solids in one place than a path keeps count of, with the name of one.
[[nodiscard]] std::string crowdedText(const Scene& scene, const FilmTallies& tallies);

} // namespace lavalight
