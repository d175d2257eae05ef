// What the render costs and how far it is.
#pragma once

#include "view/live_picture.h"

namespace lavalight {

// Draws the statistics of one image under `title`.
void drawStatistics(const char* title, const LiveStatistics& statistics);

} // namespace lavalight
