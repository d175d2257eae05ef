// Films as bytes in memory, on their way from one process to another.
#pragma once

#include <string>
#include <string_view>

#include "film/film_file.h"

namespace lavalight {

// All that a film file holds but the picture, which follows from the film. Nothing is compressed but planes
// whose pixels are all alike: sums are noise to a compressor. Some 64 bytes a pixel for colour alone.
[[nodiscard]] std::string filmBytes(const FilmFile& file);

// Throws Error that begins with "cannot read" and the name, for whatever filmBytes() did not make, or was
// damaged.
[[nodiscard]] FilmFile filmFromBytes(std::string_view bytes, const std::string& name);

} // namespace lavalight
