#include "film/film_cost.h"

#include <sstream>

#include <fmt/format.h>

namespace lavalight {

namespace {

constexpr const char* kSeconds = "render-seconds";

} // namespace

std::string textOf(const RayCounts& rays) {
    return fmt::format("{} {} {}", rays.camera, rays.indirect, rays.shadow);
}

FilmCost costOf(const FilmFile& file) {
    FilmCost cost;
    std::istringstream(valueOf(file.metadata, kSeconds)) >> cost.seconds;
    std::istringstream(valueOf(file.metadata, kRaysKey)) >> cost.rays.camera >> cost.rays.indirect >>
        cost.rays.shadow;
    return cost;
}

void setCost(FilmFile& file, const FilmCost& cost) {
    setValue(file.metadata, kSeconds, fmt::format("{:.3f}", cost.seconds));
    setValue(file.metadata, kRaysKey, textOf(cost.rays));
}

FilmCost operator+(const FilmCost& a, const FilmCost& b) {
    return {a.seconds + b.seconds, a.rays + b.rays};
}

} // namespace lavalight
