#version 460
// One vertex of each path: what it emits, what lights send it directly, and where the path goes on.
// Based on: Laine, Karras, Aila, "Megakernels Considered Harmful", HPG 2013.
#include "scene/scatter.glsl"
#include "scene/tally.glsl"
#include "scene/wave.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_HITS, std430) readonly buffer Hits { Hit hits[]; };

void main() {
    const uint bounce = range.bounce;
    if (gl_GlobalInvocationID.x >= counters[bounce].rays)
        return;
    const uint slot = queues[rayQueueStart(bounce, frame.waveSize) + gl_GlobalInvocationID.x];
    Path path = paths[slot];
    const NextRays next = scatter(hits[slot], rays[slot], slot, bounce, path);
    paths[slot] = path;
    if (next.isCut)
        tallyCutPaths(1u, fixedThroughput(path.throughput));
    if (next.crowdedSolid > 0u)
        tallyCrowded(1u, next.crowdedSolid);
    if (next.wantsShadowRay)
        shadowRays[slot] = next.shadow;
    if (next.goesOn)
        rays[slot] = next.ray;
    appendShadowRay(next.wantsShadowRay, slot, bounce, frame.waveSize);
    appendRay(next.goesOn, slot, bounce + 1u, frame.waveSize);
}
