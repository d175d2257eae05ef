#version 460
// The wavefront's kernels fused: each invocation is a lane that takes its slots' paths from the camera to their ends, one
// after another, so that the lanes of a subgroup are busy although their paths differ in length.
//
// Camera rays of one pixel, and the shadow rays of their hits, cost less where the lanes trace them at the same time, but
// soon each lane is at another vertex. With many triangles that decides: there a lane takes all its slots to the first
// vertex first, puts by the paths that go on, and takes these up again afterwards.
#include "scene/path_rays.glsl"
#include "scene/scatter.glsl"
#include "scene/tally.glsl"
#include "shared/bindings.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_PATHS, std430) buffer Paths { Path paths[]; };
layout(set = 0, binding = BINDING_LANES, std430) buffer Lanes { Lane lanes[]; };
layout(set = 0, binding = BINDING_WAITING_PATHS, std430) buffer WaitingPaths { WaitingPath waitingPaths[]; };
layout(set = 0, binding = BINDING_LANE_COUNTERS, std430) buffer LaneCounts { LaneCounters counters; };

// lavapipe gives each thread a run of neighbouring workgroups. If these were neighbours in the image too, the thread that got
// the sky would wait for the one that got the ground.
uint laneIndex() {
    const uint group = gl_WorkGroupID.x * range.groupStride % gl_NumWorkGroups.x;
    return group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
}

// A lane's i-th slot: neighbouring lanes are at neighbouring slots at the same time.
uint slotOfLane(uint index, uint i) {
    return (index / kWorkgroupSize * range.slotsPerLane + i) * kWorkgroupSize + index % kWorkgroupSize;
}

uint slotsOfLane(uint index) {
    const uint first = slotOfLane(index, 0u);
    const uint rest = slotCount() - min(first, slotCount());
    return min(range.slotsPerLane, (rest + kWorkgroupSize - 1u) / kWorkgroupSize);
}

bool hasWork(Lane lane, uint slots) {
    return lane.bounce > 0u || lane.started < slots || lane.resumed < lane.waiting;
}

// The path of the lane's next slot, or the one that has waited longest.
void takePath(uint index, uint slots, inout Lane lane, inout Path path) {
    if (!sceneHas(kFeatureManyTriangles) || lane.started < slots) {
        lane.slot = slotOfLane(index, lane.started);
        ++lane.started;
        lane.ray = cameraRayOf(lane.slot);
        path = kNewPath;
        startLayers(lane.slot);
        return;
    }
    const uint at = slotOfLane(index, lane.resumed);
    ++lane.resumed;
    lane.slot = waitingPaths[at].slot;
    lane.ray = waitingPaths[at].ray;
    lane.bounce = 1u;
    path = paths[lane.slot];
}

void putBy(uint index, Ray ray, inout Lane lane) {
    const uint at = slotOfLane(index, lane.waiting);
    ++lane.waiting;
    waitingPaths[at].slot = lane.slot;
    waitingPaths[at].ray = ray;
}

void main() {
    const uint index = laneIndex();
    const uint slots = slotsOfLane(index);
    Lane lane = lanes[index];
    if (lane.wave != range.wave) {
        lane.wave = range.wave;
        lane.slot = slotOfLane(index, 0u);
        lane.bounce = 0u;
        lane.started = 0u;
        lane.waiting = 0u;
        lane.resumed = 0u;
    }
    if (!hasWork(lane, slots))
        return;
    Path path = paths[lane.slot];
    uint indirectRays = 0u;
    uint shadowRays = 0u;
    uint cutPaths = 0u;
    uint cutThroughput = 0u;
    uint crowdedPaths = 0u;
    uint crowdedSolid = 0u;
    for (uint i = 0u; i < kVerticesPerDispatch && hasWork(lane, slots); ++i) {
        if (lane.bounce == 0u)
            takePath(index, slots, lane, path);
        const Hit hit = trace(lane.slot, lane.bounce, lane.ray);
        const NextRays next = scatter(hit, lane.ray, lane.slot, lane.bounce, path);
        shadowRays += next.wantsShadowRay ? 1u : 0u;
        if (next.wantsShadowRay && !isOccluded(next.shadow, lane.slot, lane.bounce)) {
            if (isCaught(path))
                path.throughput.y = path.throughput.x;
            else
                path.radiance += next.shadow.contribution;
        }
        cutPaths += next.isCut ? 1u : 0u;
        cutThroughput += next.isCut ? fixedThroughput(path.throughput) : 0u;
        crowdedPaths += next.crowdedSolid > 0u ? 1u : 0u;
        crowdedSolid = max(crowdedSolid, next.crowdedSolid);
        indirectRays += next.goesOn ? 1u : 0u;
        lane.ray = next.ray;
        if (next.goesOn && (!sceneHas(kFeatureManyTriangles) || lane.bounce > 0u)) {
            ++lane.bounce;
            continue;
        }
        paths[lane.slot] = path;
        if (next.goesOn)
            putBy(index, next.ray, lane);
        lane.bounce = 0u;
    }
    if (lane.bounce > 0u)
        paths[lane.slot] = path;
    lanes[index] = lane;
    atomicAdd(counters.indirectRays, indirectRays);
    atomicAdd(counters.shadowRays, shadowRays);
    tallyCutPaths(cutPaths, cutThroughput);
    tallyCrowded(crowdedPaths, crowdedSolid);
    if (hasWork(lane, slots))
        atomicAdd(counters.unfinished, 1u);
}
