#version 460
// The wavefront's kernels fused: each invocation is a lane that takes its slots' paths from the camera to their ends, one
// after another, so that the lanes of a subgroup are busy although their paths differ in length.
#include "scene/path_rays.glsl"
#include "scene/path_vertex.glsl"
#include "scene/tally.glsl"
#include "shared/bindings.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_PATHS, std430) buffer Paths { Path paths[]; };
layout(set = 0, binding = BINDING_LANES, std430) buffer Lanes { Lane lanes[]; };
layout(set = 0, binding = BINDING_LANE_COUNTERS, std430) buffer LaneCounts { LaneCounters counters; };

// lavapipe gives each thread a run of neighbouring workgroups. If these were neighbours in the image too, the thread that got
// the sky would wait for the one that got the ground.
uint laneIndex() {
    const uint group = gl_WorkGroupID.x * range.groupStride % gl_NumWorkGroups.x;
    return group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

void main() {
    const uint index = laneIndex();
    const uint first = index * range.slotsPerLane;
    const uint end = min(first + range.slotsPerLane, slotCount());
    if (first >= end)
        return;
    Lane lane = lanes[index];
    if (lane.wave != range.wave) {
        lane.wave = range.wave;
        lane.slot = first;
        lane.bounce = 0u;
    }
    if (lane.slot >= end)
        return;
    Path path = paths[lane.slot];
    uint indirectRays = 0u;
    uint shadowRays = 0u;
    uint cutPaths = 0u;
    uint cutThroughput = 0u;
    uint overlaps = 0u;
    uint overlapPair = 0u;
    for (uint i = 0u; i < kVerticesPerDispatch && lane.slot < end; ++i) {
        if (lane.bounce == 0u) {
            lane.ray = cameraRayOf(lane.slot);
            path = kNewPath;
        }
        const Hit hit = trace(lane.ray, lane.slot, lane.bounce);
        const NextRays next = scatter(hit, lane.ray, lane.slot, lane.bounce, path);
        shadowRays += next.wantsShadowRay ? 1u : 0u;
        if (next.wantsShadowRay && !isOccluded(next.shadow, lane.slot, lane.bounce))
            path.radiance += next.shadow.contribution;
        cutPaths += next.isCut ? 1u : 0u;
        cutThroughput += next.isCut ? fixedThroughput(path.throughput) : 0u;
        overlaps += next.overlap > 0u ? 1u : 0u;
        overlapPair = max(overlapPair, next.overlap);
        lane.ray = next.ray;
        if (next.goesOn) {
            ++indirectRays;
            ++lane.bounce;
        } else {
            paths[lane.slot] = path;
            ++lane.slot;
            lane.bounce = 0u;
        }
    }
    if (lane.bounce > 0u)
        paths[lane.slot] = path;
    lanes[index] = lane;
    atomicAdd(counters.indirectRays, indirectRays);
    atomicAdd(counters.shadowRays, shadowRays);
    tallyCutPaths(cutPaths, cutThroughput);
    tallyOverlaps(overlaps, overlapPair);
    if (lane.slot < end)
        atomicAdd(counters.unfinished, 1u);
}
