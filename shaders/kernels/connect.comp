#version 460
// Traces the shadow rays of the bounce and adds what arrives.
#include "scene/frame.glsl"
#include "scene/traverse.glsl"
#include "scene/wave.glsl"

layout(local_size_x = 64) in;

void main() {
    if (gl_GlobalInvocationID.x >= counters[range.bounce].shadowRays)
        return;
    const uint slot = queues[shadowQueueStart(frame.waveSize) + gl_GlobalInvocationID.x];
    const ShadowRay ray = shadowRays[slot];
    if (!intersectAny(ray.origin, ray.direction, 1.0, RayFilter(false, ray.fromTriangle, ray.toTriangle)))
        paths[slot].radiance += ray.contribution;
}
