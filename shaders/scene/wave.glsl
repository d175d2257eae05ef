// Path state and queues of the wave; each kernel writes only its own slot and appends to queues.
#extension GL_KHR_shader_subgroup_ballot : require
#include "shared/bindings.h"
#include "shared/wavefront.h"

layout(set = 0, binding = BINDING_RAYS, std430) buffer Rays { Ray rays[]; };
layout(set = 0, binding = BINDING_PATHS, std430) buffer Paths { Path paths[]; };
layout(set = 0, binding = BINDING_SHADOW_RAYS, std430) buffer ShadowRays { ShadowRay shadowRays[]; };
// Three queues of waveSize slots: rays of even bounces, rays of odd bounces, shadow rays.
layout(set = 0, binding = BINDING_QUEUES, std430) buffer Queues { uint queues[]; };
layout(set = 0, binding = BINDING_COUNTERS, std430) buffer Counters { BounceCounters counters[]; };

uint rayQueueStart(uint bounce, uint waveSize) {
    return (bounce & 1u) * waveSize;
}

uint shadowQueueStart(uint waveSize) {
    return 2u * waveSize;
}

// Compaction: one atomic per subgroup. All invocations of the subgroup that are still running must call these.
void appendRay(bool wanted, uint slot, uint bounce, uint waveSize) {
    const uvec4 ballot = subgroupBallot(wanted);
    uint first = 0u;
    if (subgroupElect())
        first = atomicAdd(counters[bounce].rays, subgroupBallotBitCount(ballot));
    first = subgroupBroadcastFirst(first);
    if (wanted)
        queues[rayQueueStart(bounce, waveSize) + first + subgroupBallotExclusiveBitCount(ballot)] = slot;
}

void appendShadowRay(bool wanted, uint slot, uint bounce, uint waveSize) {
    const uvec4 ballot = subgroupBallot(wanted);
    uint first = 0u;
    if (subgroupElect())
        first = atomicAdd(counters[bounce].shadowRays, subgroupBallotBitCount(ballot));
    first = subgroupBroadcastFirst(first);
    if (wanted)
        queues[shadowQueueStart(waveSize) + first + subgroupBallotExclusiveBitCount(ballot)] = slot;
}
