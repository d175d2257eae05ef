// What is shown of the scene: camera, lens, environment, variant, moment; and how bright.
#pragma once

#include "view/view_state.h"

namespace lavalight {

// Draws the scene's settings. Returns whether the scene must be read again for what was changed.
bool drawScene(ViewState& view);

// Draws tone mapping and exposure, which restart nothing.
void drawTone(ToneSettings& tone);

} // namespace lavalight
