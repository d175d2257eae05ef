// The exact film: integer sums per pixel, in bands of rows, on the device.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "film/film_layout.h"
#include "film/raw_film.h"
#include "gpu/buffer.h"
#include "image/rendering.h"

namespace lavalight {

// Rows [firstRow, firstRow + rows) of the image with their sums, laid out as in shaders/shared/film.h.
struct FilmBand {
    uint32_t firstRow = 0;
    uint32_t rows = 0;
    gpu::Buffer sums;
};

class Film {
  public:
    // bandRows 0: as many as one storage buffer of the device holds. Throws Error where memory does not
    // suffice. Kernels that write the film must be specialised to the layout (CONSTANT_FILM_PLANES).
    Film(gpu::Device& device, uint32_t width, uint32_t height, uint32_t bandRows,
         FilmLayout layout = colorLayout());

    [[nodiscard]] uint32_t width() const { return width_; }
    [[nodiscard]] uint32_t height() const { return height_; }
    [[nodiscard]] const FilmLayout& layout() const { return layout_; }
    [[nodiscard]] std::span<const FilmBand> bands() const { return bands_; }
    [[nodiscard]] const gpu::Buffer& tallies() const { return tallies_; }

    // Counts an id that a sample of a pixel has, for one of layout().idLayers().
    void countId(size_t layer, size_t pixel, uint32_t id) { ids_[layer].counts.add(pixel, id); }
    [[nodiscard]] const std::vector<IdLayer>& ids() const { return ids_; }

    // Zero samples everywhere.
    void clear();
    [[nodiscard]] Rendering resolve() const;
    // The layers of some of its planes alone, which costs less: bit i for row i of FILM_PLANES. Those of
    // planes that it lacks are left out.
    [[nodiscard]] Rendering resolve(uint32_t rows) const;
    [[nodiscard]] FilmTallies readTallies() const;

    // All of it, and back; `raw` must be of its size and layout.
    [[nodiscard]] RawFilm read() const;
    void restore(const RawFilm& raw);

  private:
    [[nodiscard]] RawTallies rawTallies() const;

    gpu::Device* device_;
    uint32_t width_;
    uint32_t height_;
    FilmLayout layout_;
    std::vector<FilmBand> bands_;
    std::vector<IdLayer> ids_;
    gpu::Buffer tallies_;
};

} // namespace lavalight
