// What files show of the ids that a film counts.
#pragma once

#include <string>
#include <vector>

#include "film/raw_film.h"
#include "image/exr.h"

namespace lavalight {

// Keys of the header under which the names of ids stand, as a JSON array: the first is that of id 1.
[[nodiscard]] std::string namesKey(const std::string& layer);
[[nodiscard]] std::string textOf(const std::vector<std::string>& names);

// Adds to `contents` what of the film's ids the header asks for under "option:aov": a channel of the id that
// most samples of a pixel have, or cryptomattes.
void addIdLayers(const std::vector<IdLayer>& ids, const std::vector<uint32_t>& samples,
                 const Metadata& metadata, ExrContents& contents);

} // namespace lavalight
