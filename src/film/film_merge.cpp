#include "film/film_merge.h"

#include <fmt/format.h>

#include "base/error.h"
#include "film/bias_ledger.h"
#include "film/film_cost.h"
#include "film/film_identity.h"

namespace lavalight {
namespace {

void requireComplete(const NamedFilm& film) {
    if (!film.file.isComplete())
        throw Error(
            fmt::format("cannot merge {}: its render was interrupted before all samples {} were taken; "
                        "finish it with --checkpoint {} --resume",
                        film.name, textOf(film.file.ranges), film.name));
}

void requireOneImage(const NamedFilm& a, const NamedFilm& b) {
    const auto refuse = [&](const std::string& why) {
        throw Error(fmt::format("cannot merge {} with {}: {}", b.name, a.name, why));
    };
    const std::string difference = differences({a.file.metadata, a.name}, {b.file.metadata, b.name});
    if (!difference.empty())
        refuse(fmt::format("they differ in {}", difference));
    if (a.file.film.width != b.file.film.width || a.file.film.height != b.file.film.height)
        refuse("they differ in size");
    if (!(a.file.film.layout == b.file.film.layout))
        refuse(
            fmt::format("they differ in layers ({} in {}; {} in {}); try to render the parts with the same "
                        "layers",
                        textOf(a.file.film.layout), a.name, textOf(b.file.film.layout), b.name));
    if (const auto both = overlapOf(a.file.ranges, b.file.ranges))
        refuse(fmt::format("both hold the samples {}", textOf(SampleRanges{*both})));
}

// The ledger's words come from the settings, and from the tallies of all samples.
std::string joinedLedger(const FilmFile& file) {
    std::string ofSettings = valueOf(file.metadata, kSettingsLedger);
    const std::vector<LedgerEntry> entries = tallyEntries(readable(file.film.tallies));
    if (entries.empty())
        return ofSettings;
    const bool isEmpty = ofSettings == ledgerText({});
    return (isEmpty ? "" : ofSettings + "; ") + ledgerText(entries);
}

void describeSamples(FilmFile& file) {
    const uint32_t count = countOf(file.ranges);
    setValue(file.metadata, "option:spp", fmt::format("{}", count));
    setValue(file.metadata, "option:first-sample", fmt::format("{}", file.ranges.front().first));
    setValue(file.metadata, "samples-per-pixel", samplesPerPixel(file.film.samples(), file.film.pixels()));
    setValue(file.metadata, "bias-ledger", joinedLedger(file));
}

} // namespace

void join(NamedFilm& sum, const NamedFilm& part) {
    requireComplete(sum);
    requireComplete(part);
    requireOneImage(sum, part);
    FilmFile& file = sum.file;
    const FilmCost cost = costOf(file) + costOf(part.file);
    add(file.film, part.file.film);
    file.ranges = unionOf(file.ranges, part.file.ranges);
    file.progress = {countOf(file.ranges), 0, 0};
    setCost(file, cost);
    describeSamples(file);
}

} // namespace lavalight
