// What of the scene an image shows, by its camera and its shape.
#pragma once

#include "scene/scene.h"

namespace lavalight {

// Half the height and width of what an image of these sides shows, at distance 1 (perspective) or at all
// (orthographic). glTF 2.0, 3.10.3: viewports of another aspect ratio should not crop.
struct ViewExtent {
    float halfWidth = 0.0f;
    float halfHeight = 0.0f;
    // Where the middle of the image lies beside the axis of the view, at distance 1 to the right and up.
    float middleRight = 0.0f;
    float middleUp = 0.0f;
};
[[nodiscard]] ViewExtent viewExtent(const Camera& camera, float width, float height);

} // namespace lavalight
