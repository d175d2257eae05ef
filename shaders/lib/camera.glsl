// Camera rays.
#include "lib/math/constants.glsl"
#include "lib/math/equirectangular.glsl"
#include "lib/features.glsl"
#include "lib/sampling/warp.glsl"
#include "shared/frame.h"
#include "shared/wavefront.h"

// A point of the lens sees the point of the plane in focus that its middle would see: Cook, Porter, Carpenter,
// "Distributed Ray Tracing", 1984. `throughMiddle` reaches the plane at distance 1 from the camera.
void moveOnLens(FrameParameters parameters, vec2 lens, inout vec3 origin, vec3 throughMiddle, out vec3 direction) {
    const vec2 p = parameters.lensRadius * squareToDisk(lens);
    const vec3 onLens = p.x * normalize(parameters.cameraRight) + p.y * normalize(parameters.cameraUp);
    origin += onLens;
    direction = normalize(parameters.focusDistance * throughMiddle - onLens);
}

// Where a camera ray ends: on the far plane, if there is one (glTF 2.0, 3.10.3). Panoramas have no planes.
float cameraRayEnd(FrameParameters parameters, vec3 direction) {
    return sceneHas(kFeaturePanorama) ? kInfinity : parameters.clipDepth / dot(direction, parameters.cameraForward);
}

// The ray starts on the near plane. `position` in pixels from the top left corner of the image; `lens`: random, for a point
// on the lens.
Ray cameraRay(FrameParameters parameters, vec2 position, vec2 lens) {
    const vec2 uv = position / vec2(parameters.imageWidth, parameters.imageHeight);
    const vec2 ndc = 2.0 * uv - vec2(parameters.axisX, parameters.axisY); // 0 on the axis of the view
    const vec3 onPlane = ndc.x * parameters.cameraRight - ndc.y * parameters.cameraUp;
    vec3 origin = parameters.cameraPosition;
    vec3 direction = normalize(parameters.cameraForward + onPlane);
    if (sceneHas(kFeatureOrthographic)) {
        origin += onPlane;
        direction = parameters.cameraForward;
    }
    if (sceneHas(kFeaturePanorama))
        direction = equirectangularToDirection(uv);
    if (sceneHas(kFeatureLens))
        moveOnLens(parameters, lens, origin, parameters.cameraForward + onPlane, direction);
    if (!sceneHas(kFeaturePanorama)) // without a near plane this adds 0, which is cheaper than a branch on uniforms
        origin += direction * (parameters.clipNear / dot(direction, parameters.cameraForward));
    const InteriorList interior = InteriorList(parameters.startOuter, parameters.startInner, parameters.startNotes);
    return Ray(origin, kNoSurface, direction, 0.0, 0u, interior);
}

// Where a pinhole camera with these vectors of `parameters` shows a point: a share of the image's sides from its top left
// corner; `axis` as axisX and axisY of the parameters. Points behind the camera have no such place.
vec2 placeInImage(vec2 axis, vec3 toPoint, vec3 right, vec3 up, vec3 forward) {
    if (sceneHas(kFeaturePanorama))
        return directionToEquirectangular(normalize(toPoint));
    const float depth = sceneHas(kFeatureOrthographic) ? 1.0 : dot(toPoint, forward);
    const vec2 ndc = vec2(dot(toPoint, right) / dot(right, right), -dot(toPoint, up) / dot(up, up)) / depth;
    return 0.5 * ndc + 0.5 * axis;
}

// How far a point moves to the next frame, in pixels to the right and down. Panoramas are round.
vec2 pixelMotion(FrameParameters parameters, vec3 now, vec3 next) {
    const vec2 axis = vec2(parameters.axisX, parameters.axisY);
    const vec2 from = placeInImage(axis, now - parameters.cameraPosition, parameters.cameraRight, parameters.cameraUp,
                                   parameters.cameraForward);
    const vec2 to =
        placeInImage(axis, next - parameters.nextPosition, parameters.nextRight, parameters.nextUp, parameters.nextForward);
    vec2 way = to - from;
    if (sceneHas(kFeaturePanorama))
        way.x -= round(way.x);
    return way * vec2(parameters.imageWidth, parameters.imageHeight);
}
