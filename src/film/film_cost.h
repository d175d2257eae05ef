// What the samples of a film have cost so far.
#pragma once

#include <cstdint>
#include <string>

#include "film/film_file.h"

namespace lavalight {

// Rays traced so far.
struct RayCounts {
    uint64_t camera = 0;
    uint64_t indirect = 0;
    uint64_t shadow = 0;
    [[nodiscard]] uint64_t total() const { return camera + indirect + shadow; }
    [[nodiscard]] RayCounts operator+(const RayCounts& more) const {
        return {camera + more.camera, indirect + more.indirect, shadow + more.shadow};
    }
};

struct FilmCost {
    double seconds = 0.0;
    RayCounts rays;
};
[[nodiscard]] FilmCost operator+(const FilmCost& a, const FilmCost& b);

// Header key of the rays, beside "render-seconds".
inline constexpr const char* kRaysKey = "film:rays";
[[nodiscard]] std::string textOf(const RayCounts& rays);

[[nodiscard]] FilmCost costOf(const FilmFile& file);
void setCost(FilmFile& file, const FilmCost& cost);

} // namespace lavalight
