#version 460
// Finds the closest hit of every ray in the bounce's queue.
#include "scene/path_rays.glsl"
#include "scene/wave.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_HITS, std430) writeonly buffer Hits { Hit hits[]; };

void main() {
    if (gl_GlobalInvocationID.x >= counters[range.bounce].rays)
        return;
    const uint slot = queues[rayQueueStart(range.bounce, frame.waveSize) + gl_GlobalInvocationID.x];
    Ray ray = rays[slot];
    hits[slot] = trace(slot, range.bounce, ray);
    if (sceneHas(kFeatureSolids))
        rays[slot].interior = ray.interior;
}
