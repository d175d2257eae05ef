// What the render costs and how far it is.
#pragma once

#include "view/live_picture.h"

namespace lavalight {

// Of one image; `title` stands above it.
void drawStatistics(const char* title, const LiveStatistics& statistics);

} // namespace lavalight
