#include "scene/view_extent.h"

#include <cmath>

namespace lavalight {
namespace {

ViewExtent extentOf(const Intrinsics& intrinsics, const glm::dvec2& size) {
    const glm::dvec2 half = 0.5 * size / intrinsics.focal;
    const glm::dvec2 middle = (0.5 * size - intrinsics.center) / intrinsics.focal;
    return {static_cast<float>(half.x), static_cast<float>(half.y), static_cast<float>(middle.x),
            static_cast<float>(-middle.y)};
}

} // namespace

ViewExtent viewExtent(const Camera& camera, float width, float height) {
    if (camera.intrinsics)
        return extentOf(*camera.intrinsics, {width, height});
    float halfHeight = camera.projection == Projection::orthographic ? camera.halfHeight
                                                                     : std::tan(0.5f * camera.verticalFov);
    // An image as wide as whole pixels can make it is not narrower: half a pixel is cut on either side.
    const float framedWidth = camera.framedAspect * height;
    if (camera.projection != Projection::panorama && std::round(framedWidth) > width)
        halfHeight *= framedWidth / width;
    return {halfHeight * (width / height), halfHeight};
}

} // namespace lavalight
