// The image of a film whose scene and renderer are elsewhere: of a part that arrived, or of a merge.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "film/film_merge.h"
#include "gpu/device.h"
#include "image/exr.h"
#include "render/tone_mapper.h"
#include "session/outputs.h"

namespace lavalight {

struct DevelopedFilm {
    FinishedImage image; // without pixels, and with its film
    Metadata header;     // of an EXR file that does not hold the film
    std::string report;  // JSON
};

// What a render of all of the film's samples would have finished, in that style. Throws Error, naming the
// film, where it lacks what denoising reads.
[[nodiscard]] DevelopedFilm developFilm(NamedFilm film, OutputStyle style);

// The pixels that such an image lacks.
[[nodiscard]] std::vector<uint32_t> pixelsOf(const FinishedImage& image, gpu::Device& device,
                                             ToneMapper& toneMapper);

} // namespace lavalight
