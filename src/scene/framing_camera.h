// Cameras that frame what there is: for scenes that bring none, and views by name.
#pragma once

#include "scene/scene.h"

namespace lavalight {

// Looks at the middle of `bounds` from the front (+z), the right and somewhat above, close enough that the
// box just fits an image of any aspect ratio from 1. An empty box is taken as one of 1 m around its corner.
[[nodiscard]] Camera framingCamera(const Bounds& bounds);

// Where a view looks from. glTF's models face +z.
enum class NamedView {
    none,
    front,       // from +z
    back,        // from -z
    left,        // from -x, the left hand of somebody who looks at the front
    right,       // from +x
    top,         // from +y, the front below
    bottom,      // from -y, the front above
    threeQuarter // from the front, the right and somewhat above
};

// The image that a view is for, and its lens.
struct ViewFrame {
    float aspect = 1.0f;      // width / height
    float verticalFov = 0.6f; // radians
};

// Looks from there, as near as it can with all vertices in the image and a margin around them. `view` is not
// `none`.
[[nodiscard]] Camera viewCamera(const Scene& scene, NamedView view, const ViewFrame& frame);

// The view after so many turns about the scene's vertical, counter-clockwise as seen from above; at a
// distance that suits all turns. The view must not be from above or below.
[[nodiscard]] Camera turnedCamera(const Scene& scene, NamedView view, float turns, const ViewFrame& frame);

} // namespace lavalight
