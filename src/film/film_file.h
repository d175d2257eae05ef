// Images that can be continued and joined: EXR files that hold the exact film beside the picture, and all
// that decides its bits in their header. Parts of --samples, results of merge and checkpoints are all such
// files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "film/film_windows.h"
#include "film/raw_film.h"
#include "film/sample_ranges.h"
#include "image/exr.h"

namespace lavalight {

struct FilmFile {
    RawFilm film;
    SampleRanges ranges; // samples that it is to hold, or holds
    FilmProgress progress;
    Metadata metadata;              // entries of exrMetadata(), and kSettingsLedger
    std::optional<FilmPart> part{}; // none: the film is of the whole image

    [[nodiscard]] bool isComplete() const { return progress == FilmProgress{countOf(ranges), 0, 0}; }
};

// The bias ledger without what tallies say.
inline constexpr const char* kSettingsLedger = "film:settings-ledger";

// The channels of writeExr, and those of the film, 32-bit unsigned:
//   raw.R.sum.0 1 2       sum of the samples' L, words from the lowest, the lowest bit worth 2^-48
//   raw.R.square.0 1 2 3  sum of their L^2, the lowest bit worth 2^-64
// and so for G and B, and for the channels of each further layer; sums of layers with negative values are of
// four words, in two's complement. The header names the film's layout; without it, colour is all there is. A
// hash of the film and the header makes damage known. `more`: further layers, which readFilmFile ignores.
// Throws Error.
void writeFilmFile(const std::filesystem::path& path, const FilmFile& file, std::span<const Layer> more = {});

// Throws Error for whatever is no such file, or was damaged.
[[nodiscard]] FilmFile readFilmFile(const std::filesystem::path& path);

// How far a film is, by its header alone.
struct FilmState {
    double fraction = 0.0; // of the samples that it is to hold
    double seconds = 0.0;  // that rendering took
};

// Throws Error for whatever is no such file.
[[nodiscard]] FilmState readFilmState(const std::filesystem::path& path);

// What is stored of a film beside the picture: its words plane by plane, then those of its ids, under a
// header with a hash of them all. filmOf() reads it back, and throws Error, which names no file, for anything
// else.
[[nodiscard]] UintImage storedFilm(const FilmFile& file);
[[nodiscard]] FilmFile filmOf(UintImage stored);

// Value of a key, or empty.
[[nodiscard]] std::string valueOf(const Metadata& metadata, const std::string& key);
// Replaces the key's value, or adds it.
void setValue(Metadata& metadata, const std::string& key, const std::string& value);

} // namespace lavalight
