// Camera rays.
#include "shared/frame.h"
#include "shared/wavefront.h"

// `position` in pixels from the top left corner of the image.
Ray cameraRay(FrameParameters frame, vec2 position) {
    const vec2 ndc = 2.0 * position / vec2(frame.imageWidth, frame.imageHeight) - 1.0;
    const vec3 onPlane = ndc.x * frame.cameraRight - ndc.y * frame.cameraUp;
    if (frame.isOrthographic != 0u)
        return Ray(frame.cameraPosition + onPlane, kNoTriangle, frame.cameraForward, 0.0, 0u, uint[3](0u, 0u, 0u));
    return Ray(frame.cameraPosition, kNoTriangle, normalize(frame.cameraForward + onPlane), 0.0, 0u,
               uint[3](0u, 0u, 0u));
}
