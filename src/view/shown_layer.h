// Which picture of an image the window shows: its colour, that denoised, or a layer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "film/film_layout.h"

namespace lavalight {

struct ShownLayer {
    uint32_t row = kColorPlane; // of FILM_PLANES
    bool isDenoised = false;    // the colour alone
    bool operator==(const ShownLayer&) const = default;
};

// The denoised colour.
inline constexpr ShownLayer kDenoisedColor{kColorPlane, true};

// All that can be chosen, in the order of keys and lists: colour, denoised colour, layers.
[[nodiscard]] std::vector<ShownLayer> shownLayers();

// What a list calls it.
[[nodiscard]] std::string nameOf(const ShownLayer& shown);

// The one so many steps on in shownLayers(), around its ends; the denoised colour is passed over where it
// cannot be shown.
[[nodiscard]] ShownLayer stepped(const ShownLayer& shown, int steps, bool canDenoise);

// Planes of the film that it needs beside the colour: bit i for row i (RenderSettings::layers). One layer
// brings all that can be chosen, so that the way from one to the next restarts nothing.
[[nodiscard]] uint32_t planesFor(const ShownLayer& shown);

} // namespace lavalight
