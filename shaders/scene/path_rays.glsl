// The rays of a path: from the camera, between vertices, and to lights.
#include "lib/camera.glsl"
#include "scene/frame.glsl"
#include "scene/intersect.glsl"

const Path kNewPath = Path(vec3(1.0), 0.0, vec3(0.0), 1.0);

// Through a random point of the slot's pixel, and of the lens.
Ray cameraRayOf(uint slot) {
    const uint pixel = pixelOfSlot(slot);
    const vec2 corner = vec2(pixel % frame.imageWidth, pixel / frame.imageWidth);
    const SampleKey key = keyOfSlot(slot, 0u);
    const vec2 lens = sceneHas(kFeatureLens) ? sample2D(key, kDimensionLens) : vec2(0.0);
    return cameraRay(frame, corner + sample2D(key, kDimensionPixel), lens);
}

// The closest hit; t is infinite where there is none. glTF's back-face culling is for the camera alone: light transport
// needs closed surfaces.
Hit trace(Ray ray, uint slot, uint bounce) {
    const RayFilter ignored = RayFilter(bounce == 0u, ray.fromSurface, kNoSurface,
                                        alphaSeed(keyOfSlot(slot, bounce), kDimensionAlpha));
    const float end = bounce == 0u ? cameraRayEnd(frame, ray.direction) : kInfinity;
    Hit hit;
    if (!intersectClosest(ray.origin, ray.direction, end, ignored, hit))
        hit.t = kInfinity;
    return hit;
}

// Whether something stops the shadow ray of the vertex after `bounce` others.
bool isOccluded(ShadowRay ray, uint slot, uint bounce) {
    const RayFilter ignored = RayFilter(false, ray.fromSurface, ray.toSurface,
                                        alphaSeed(keyOfSlot(slot, bounce + 1u), kDimensionShadowAlpha));
    return intersectAny(ray.origin, ray.direction, 1.0, ignored);
}
