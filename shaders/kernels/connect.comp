#version 460
// Traces the shadow rays of the bounce and adds what arrives.
#include "scene/path_rays.glsl"
#include "scene/wave.glsl"

layout(local_size_x = 64) in;

void main() {
    if (gl_GlobalInvocationID.x >= counters[range.bounce].shadowRays)
        return;
    const uint slot = queues[shadowQueueStart(frame.waveSize) + gl_GlobalInvocationID.x];
    const ShadowRay ray = shadowRays[slot];
    if (isOccluded(ray, slot, range.bounce))
        return;
    if (isCaught(paths[slot]))
        paths[slot].throughput.y = paths[slot].throughput.x;
    else
        paths[slot].radiance += ray.contribution;
}
