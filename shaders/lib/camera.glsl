// Camera rays.
#include "lib/equirectangular.glsl"
#include "lib/features.glsl"
#include "lib/warp.glsl"
#include "shared/frame.h"
#include "shared/wavefront.h"

Ray rayFromCamera(vec3 origin, vec3 direction) {
    return Ray(origin, kNoTriangle, direction, 0.0, 0u, uint[3](0u, 0u, 0u));
}

// A point of the lens sees the point of the plane in focus that its middle would see: Cook, Porter, Carpenter,
// "Distributed Ray Tracing", 1984. `throughMiddle` reaches the plane at distance 1 from the camera.
Ray rayThroughLens(FrameParameters frame, vec3 throughMiddle, vec2 lens) {
    const vec2 p = frame.lensRadius * squareToDisk(lens);
    const vec3 onLens = p.x * normalize(frame.cameraRight) + p.y * normalize(frame.cameraUp);
    return rayFromCamera(frame.cameraPosition + onLens, normalize(frame.focusDistance * throughMiddle - onLens));
}

// `position` in pixels from the top left corner of the image; `lens`: random, for a point on the lens.
Ray cameraRay(FrameParameters frame, vec2 position, vec2 lens) {
    const vec2 uv = position / vec2(frame.imageWidth, frame.imageHeight);
    const vec2 ndc = 2.0 * uv - 1.0;
    const vec3 onPlane = ndc.x * frame.cameraRight - ndc.y * frame.cameraUp;
    if (sceneHas(kFeatureSpecialCamera) && frame.projection == kProjectionPanorama)
        return rayFromCamera(frame.cameraPosition, equirectangularToDirection(uv));
    if (frame.projection == kProjectionOrthographic)
        return rayFromCamera(frame.cameraPosition + onPlane, frame.cameraForward);
    if (sceneHas(kFeatureSpecialCamera) && frame.lensRadius > 0.0)
        return rayThroughLens(frame, frame.cameraForward + onPlane, lens);
    return rayFromCamera(frame.cameraPosition, normalize(frame.cameraForward + onPlane));
}
