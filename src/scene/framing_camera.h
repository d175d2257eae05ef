// A camera for scenes that bring none.
#pragma once

#include "scene/scene.h"

namespace lavalight {

// Looks at the middle of `bounds` from the front (+z), the right and somewhat above, close enough that the
// box just fits an image of any aspect ratio from 1. An empty box is taken as one of 1 m around its corner.
[[nodiscard]] Camera framingCamera(const Bounds& bounds);

} // namespace lavalight
