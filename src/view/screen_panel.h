// Which pictures of the image are shown, and how: layers, denoising, background, tone.
#pragma once

#include "view/live_picture.h"
#include "view/view_state.h"

namespace lavalight {

// Draws the settings of what is shown. `exposure`: stops that it is shown with now.
void drawScreen(ViewState& view, float exposure);

} // namespace lavalight
