// What is shown of the scene: camera, lens, environment, variant, moment.
#pragma once

#include "view/view_state.h"

namespace lavalight {

// Draws the scene's settings. Returns whether the scene must be read again for what was changed.
bool drawScene(ViewState& view);

} // namespace lavalight
