// A pixel under the magnifying glass: its value, and one of its paths.
#pragma once

#include <glm/glm.hpp>

#include "view/live_picture.h"
#include "view/view_state.h"

namespace lavalight {

// Draws the table. Returns whether another sample's path is asked for: `sample` is then its number.
bool drawInspection(const PixelInspection& inspection, uint32_t& sample);

// Draws the path over a window of that many points, as the view's camera sees it.
void drawPath(const PixelInspection& inspection, const ViewState& view, const glm::vec2& window);

} // namespace lavalight
