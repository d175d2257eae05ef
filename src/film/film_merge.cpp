#include "film/film_merge.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "film/bias_ledger.h"
#include "film/film_cost.h"
#include "film/film_identity.h"
#include "film/film_machines.h"

namespace lavalight {
namespace {

constexpr const char* kCropKey = "option:crop";

void requireComplete(const NamedFilm& film) {
    if (!film.file.isComplete())
        throw Error(
            fmt::format("cannot merge {}: its render was interrupted before all samples {} were taken; "
                        "finish it with --checkpoint {} --resume",
                        film.name, textOf(film.file.ranges), film.name));
}

// Sides of the image that the film is a part of.
glm::uvec2 wholeOf(const FilmFile& file) {
    return file.part ? file.part->whole : glm::uvec2(file.film.width, file.film.height);
}

PixelWindows windowsOf(const FilmFile& file) {
    return file.part ? file.part->windows : PixelWindows{{0, 0, file.film.width, file.film.height}};
}

// The film in larger bounds: pixels without samples around it.
RawFilm widened(const RawFilm& film, const PixelWindow& from, const PixelWindow& to) {
    RawFilm wide{to.width, to.height, {}, film.tallies, film.layout};
    wide.words.resize(film.layout.words() * wide.pixels());
    for (size_t word = 0; word < film.layout.words(); ++word)
        for (uint32_t row = 0; row < from.height; ++row) {
            const size_t first =
                word * wide.pixels() + size_t{row + from.y - to.y} * to.width + from.x - to.x;
            std::copy_n(film.words.begin() +
                            static_cast<ptrdiff_t>(word * film.pixels() + size_t{row} * from.width),
                        from.width, wide.words.begin() + static_cast<ptrdiff_t>(first));
        }
    wide.ids = emptyIds(film.layout, wide.pixels());
    for (size_t i = 0; i < film.ids.size(); ++i)
        for (size_t pixel = 0; pixel < film.pixels(); ++pixel) {
            const size_t place =
                (pixel / from.width + from.y - to.y) * to.width + pixel % from.width + from.x - to.x;
            for (const IdCount& counted : film.ids[i].counts.ranked(pixel))
                wide.ids[i].counts.add(place, counted.id, counted.count);
        }
    return wide;
}

// Puts parts of an image beside each other.
void joinWindows(FilmFile& sum, const FilmFile& part) {
    const glm::uvec2 whole = wholeOf(sum);
    const PixelWindow ofSum = boundsOf(windowsOf(sum));
    const PixelWindow ofPart = boundsOf(windowsOf(part));
    const PixelWindows windows = unionOf(windowsOf(sum), windowsOf(part));
    const PixelWindow bounds = boundsOf(windows);
    sum.film = widened(sum.film, ofSum, bounds);
    add(sum.film, widened(part.film, ofPart, bounds));
    const bool isWhole = windows == PixelWindows{{0, 0, whole.x, whole.y}};
    sum.part = isWhole ? std::nullopt : std::optional(FilmPart{whole, windows});
    std::erase_if(sum.metadata, [](const auto& pair) { return pair.first == kCropKey; });
    if (!isWhole)
        setValue(sum.metadata, kCropKey, textOf(windows));
}

// The end of a refusal, where the films differ in nothing but their machines.
std::string remedyOf(const FilmHeader& a, const FilmHeader& b) {
    return differences(a, b, {}, Machines::any).empty()
               ? "; try --statistical, which asks for equal means in place of equal bits"
               : "";
}

void requireOneImage(const NamedFilm& a, const NamedFilm& b, Machines machines) {
    const auto refuse = [&](const std::string& why) {
        throw Error(fmt::format("cannot merge {} with {}: {}", b.name, a.name, why));
    };
    const FilmHeader ofA{a.file.metadata, a.name};
    const FilmHeader ofB{b.file.metadata, b.name};
    const std::string difference = differences(ofA, ofB, {}, machines);
    if (!difference.empty())
        refuse(fmt::format("they differ in {}{}", difference, remedyOf(ofA, ofB)));
    if (wholeOf(a.file) != wholeOf(b.file))
        refuse("they differ in size");
    if (!(a.file.film.layout == b.file.film.layout))
        refuse(
            fmt::format("they differ in layers ({} in {}; {} in {}); try to render the parts with the same "
                        "layers",
                        textOf(a.file.film.layout), a.name, textOf(b.file.film.layout), b.name));
    if (windowsOf(a.file) == windowsOf(b.file)) {
        if (const auto both = overlapOf(a.file.ranges, b.file.ranges))
            refuse(fmt::format("both hold the samples {}", textOf(SampleRanges{*both})));
        return;
    }
    if (const auto both = overlapOf(windowsOf(a.file), windowsOf(b.file)))
        refuse(
            fmt::format("they are different parts of the image, and both hold its pixels {}", textOf(*both)));
    if (a.file.ranges != b.file.ranges)
        refuse(fmt::format(
            "they are different parts of the image, of different samples ({} in {}, {} in {}); try "
            "to merge all samples of each part first",
            textOf(a.file.ranges), a.name, textOf(b.file.ranges), b.name));
}

// The ledger's words come from the settings, and from the tallies of all samples.
std::string joinedLedger(const FilmFile& file) {
    std::string ofSettings = valueOf(file.metadata, kSettingsLedger);
    std::vector<LedgerEntry> entries = machineEntries(file.metadata);
    for (LedgerEntry& entry : tallyEntries(readable(file.film.tallies)))
        entries.push_back(std::move(entry));
    if (entries.empty())
        return ofSettings;
    const bool isEmpty = ofSettings == ledgerText({});
    return (isEmpty ? "" : ofSettings + "; ") + ledgerText(entries);
}

void describeSamples(FilmFile& file) {
    const uint32_t count = countOf(file.ranges);
    setValue(file.metadata, "option:spp", fmt::format("{}", count));
    setValue(file.metadata, "option:first-sample", fmt::format("{}", file.ranges.front().first));
    setValue(file.metadata, "samples-per-pixel",
             samplesPerPixel(file.film.samples(), pixelsOf(windowsOf(file))));
    setValue(file.metadata, "bias-ledger", joinedLedger(file));
}

} // namespace

void join(NamedFilm& sum, const NamedFilm& part, Machines machines) {
    requireComplete(sum);
    requireComplete(part);
    requireOneImage(sum, part, machines);
    FilmFile& file = sum.file;
    if (machines == Machines::any)
        joinMachines(file, part.file);
    // A film that does not say these takes the other's word, which the next one is held to.
    for (const char* key : {"commit", "processor"})
        if (const std::string ofPart = valueOf(part.file.metadata, key);
            !ofPart.empty() && valueOf(file.metadata, key).empty())
            setValue(file.metadata, key, ofPart);
    const FilmCost cost = costOf(file) + costOf(part.file);
    if (windowsOf(file) == windowsOf(part.file))
        add(file.film, part.file.film);
    else
        joinWindows(file, part.file);
    if (file.ranges != part.file.ranges)
        file.ranges = unionOf(file.ranges, part.file.ranges);
    file.progress = {countOf(file.ranges), 0, 0};
    setCost(file, cost);
    describeSamples(file);
}

} // namespace lavalight
