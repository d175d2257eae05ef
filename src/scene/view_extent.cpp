#include "scene/view_extent.h"

#include <cmath>

namespace lavalight {

ViewExtent viewExtent(const Camera& camera, float width, float height) {
    float halfHeight = camera.projection == Projection::orthographic ? camera.halfHeight
                                                                     : std::tan(0.5f * camera.verticalFov);
    // An image as wide as whole pixels can make it is not narrower: half a pixel is cut on either side.
    const float framedWidth = camera.framedAspect * height;
    if (camera.projection != Projection::panorama && std::round(framedWidth) > width)
        halfHeight *= framedWidth / width;
    return {halfHeight * (width / height), halfHeight};
}

} // namespace lavalight
