// The kinds of machine that took a film's samples. Their last bits may differ, their means do not.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "film/bias_ledger.h"
#include "film/film_file.h"

namespace lavalight {

// Keys of the header that say what kind of machine took the samples.
inline constexpr std::array<std::string_view, 4> kMachineKeys{"device", "driver", "processor",
                                                              "content:accelerator"};
// The key of films that hold samples of several kinds: how many each has taken.
inline constexpr const char* kMachines = "machines";

// Where the two films are of different kinds, writes all kinds and their numbers of samples into the header
// of `sum`. Call it before the samples of `part` are added to `sum`.
void joinMachines(FilmFile& sum, const FilmFile& part);

// The entry of the ledger that names each kind; none for a film of one.
[[nodiscard]] std::vector<LedgerEntry> machineEntries(const Metadata& metadata);

} // namespace lavalight
