// Film files made up for tests.
#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "film/film_file.h"

namespace lavalight::test {

// A film with negative values in one of its layers, which no render asks for.
inline FilmLayout signedLayout() {
    std::vector<LayerPlane> planes(colorLayout().planes().begin(), colorLayout().planes().end());
    planes.push_back({"tilt", {"tilt.X", "tilt.Y"}, {2, 1, 0, 0}});
    planes.push_back({"height", {"height.Z"}, {1, 1, 1, 0}});
    return FilmLayout(std::move(planes));
}

// A film of random words, and a header of a few keys.
inline FilmFile someFilm(uint32_t seed, SampleRange range, const FilmLayout& layout = colorLayout()) {
    std::mt19937 generator(seed);
    FilmFile file;
    file.film.width = 5;
    file.film.height = 4;
    file.film.layout = layout;
    for (size_t i = 0; i < layout.words() * file.film.pixels(); ++i)
        file.film.words.push_back(static_cast<uint32_t>(generator()) >> 3); // sums of a few do not overflow
    file.film.tallies = {1, 0, 3, 3 * 32768, 0, 0, 2, 0};
    file.ranges = {range};
    file.progress = {range.end - range.first, 0, 0};
    file.metadata = {{"version", "1"},
                     {"device", "some device"},
                     {"driver", "some driver"},
                     {"scene", "box.gltf"},
                     {"render-seconds", "1.500"},
                     {"bias-ledger", "clamp-indirect: 5; dropped-samples: 1"},
                     {"option:seed", "0"},
                     {"option:spp", std::to_string(range.end - range.first)},
                     {"option:first-sample", std::to_string(range.first)},
                     {"option:env", "a.hdr"},
                     {"content:textures", "0123456789abcdef"},
                     {kSettingsLedger, "clamp-indirect: 5"}};
    return file;
}

// The message of the Error that `act` throws; empty if it does not.
template <typename Act>
std::string errorOf(const Act& act) {
    try {
        act();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

} // namespace lavalight::test
