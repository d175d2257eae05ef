#version 460
// Finds the closest hit of every ray in the bounce's queue.
#include "scene/frame.glsl"
#include "scene/traverse.glsl"
#include "scene/wave.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_HITS, std430) writeonly buffer Hits { Hit hits[]; };

void main() {
    if (gl_GlobalInvocationID.x >= counters[range.bounce].rays)
        return;
    const uint slot = queues[rayQueueStart(range.bounce, frame.waveSize) + gl_GlobalInvocationID.x];
    const Ray ray = rays[slot];
    // glTF's back-face culling is for the camera alone: light transport needs closed surfaces.
    const RayFilter ignored = RayFilter(range.bounce == 0u, ray.fromTriangle, kNoTriangle);
    Hit hit;
    if (!intersectClosest(ray.origin, ray.direction, kInfinity, ignored, hit))
        hit.t = kInfinity;
    hits[slot] = hit;
}
