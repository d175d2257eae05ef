// The ground that catches shadows: a plane under everything, which camera rays alone see. Since it is under everything, a ray
// that meets nothing and points down meets it, and it need not be among the triangles.
#include "lib/camera.glsl"
#include "lib/features.glsl"
#include "lib/math/constants.glsl"
#include "lib/math/luminance.glsl"
#include "scene/frame.glsl"
#include "scene/light.glsl"

// The farthest that the ground catches shadows, in times the distance from the start of a ray through the scene: less than half
// a pixel below the horizon at 4,000 pixels a radian. Farther away, squares of distances would leave single precision.
const float kFarthestCatch = 1e4;

float distanceToGround(Ray ray) {
    return (frame.groundHeight - ray.origin.y) / ray.direction.y;
}

// Whether a ray that met nothing, after `bounce` vertices, meets the ground.
bool meetsGround(Ray ray, uint bounce) {
    if (!sceneHas(kFeatureShadowCatcher) || frame.catchesShadows == 0u || bounce > 0u)
        return false;
    const float t = distanceToGround(ray);
    const float reach = kFarthestCatch * (frame.sceneRadius + distance(ray.origin, frame.sceneCenter));
    return ray.direction.y < 0.0 && t > 0.0 && t < min(reach, cameraRayEnd(frame, ray.direction));
}

// Ends a path where it meets the ground, with one sample of the light on a white Lambert surface there. False: no shadow ray
// is needed, for the sample brings nothing. The shadow ray adds no radiance.
bool catchLight(Ray ray, uint slot, inout Path path, out ShadowRay shadow) {
    const vec3 n = vec3(0.0, 1.0, 0.0);
    const vec3 met = ray.origin + distanceToGround(ray) * ray.direction;
    const vec3 p = vec3(met.x, frame.groundHeight, met.z);
    path.etaScale = kCaught;
    path.throughput = vec3(0.0);
    if (!sceneHas(kFeatureLights))
        return false;
    const LightSample light =
        sampleLight(frame, Receiver(p, n, false), n, sampleBits2D(keyOfSlot(slot, 1u), kDimensionLight));
    const float cosine = max(dot(light.wi, n), 0.0);
    if (cosine > 0.0 && light.pdf > 0.0)
        path.throughput.x = luminance(light.radiance) * (cosine / (kPi * light.pdf));
    shadow.origin = p;
    shadow.fromSurface = kNoSurface;
    shadow.direction = light.end - p;
    shadow.toSurface = light.surface;
    shadow.contribution = vec3(0.0);
    return path.throughput.x != 0.0;
}
