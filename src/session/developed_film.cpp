#include "session/developed_film.h"

#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "film/bias_ledger.h"
#include "film/id_layers.h"
#include "render/film.h"
#include "session/denoised.h"
#include "session/exposure.h"
#include "session/report.h"

namespace lavalight {
namespace {

void requireGuides(const NamedFilm& film) {
    for (uint32_t row = 0; row < kFilmPlaneCount; ++row)
        if ((kDenoisingLayers >> row & 1u) != 0 && !film.file.film.layout.find(row))
            throw Error(fmt::format("cannot denoise {}: it has no layer {}, which denoising reads; try to "
                                    "render its parts with --denoise",
                                    film.name, planeName(row)));
}

bool isSharp(const FilmFile& film) {
    return valueOf(film.metadata, "option:aperture").empty();
}

} // namespace

DevelopedFilm developFilm(NamedFilm film, OutputStyle style) {
    DevelopedFilm developed;
    FinishedImage& image = developed.image;
    image.rendering = resolve(film.file.film);
    if (film.file.part)
        image.rendering.place = placeOf(*film.file.part);
    addIdLayers(film.file.film.ids, image.rendering.sampleCounts, film.file.metadata, image.ids);
    std::vector<LedgerEntry> ledger = parseLedger(valueOf(film.file.metadata, "bias-ledger"));
    if (style.denoiser) {
        requireGuides(film);
        addDenoised(ledger, image.rendering, *style.denoiser, style.quality, style.layers,
                    isSharp(film.file));
    }
    if (style.exposesByImage)
        style.tone.exposure = autoExposure(image.rendering);
    image.tone = style.tone;
    developed.header = exrMetadata(film.file, ledger);
    developed.report = filmReportJson(film.file, image.rendering, ledger, image.tone);
    image.holdsFilm = style.keepsFilm;
    image.film = std::move(film.file);
    return developed;
}

std::vector<uint32_t> pixelsOf(const FinishedImage& image, gpu::Device& device, ToneMapper& toneMapper) {
    if (image.rendering.find(kDenoisedLayer) != nullptr)
        return denoisedPixels(image.rendering, toneMapper, image.tone.value());
    const RawFilm& raw = image.film.value().film;
    Film film(device, raw.width, raw.height, 0, raw.layout);
    film.restore(raw);
    return toneMapper.map(film, image.tone.value());
}

} // namespace lavalight
