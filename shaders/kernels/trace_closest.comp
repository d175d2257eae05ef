#version 460
// Finds the closest hit of rays that the host made, as extend does for those of a wave: for benchmarks and tests.
#include "lib/math/constants.glsl"
#include "scene/visit_counts.glsl"
#include "shared/trace.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_RAYS, std430) readonly buffer Rays { Ray rays[]; };
layout(set = 0, binding = BINDING_HITS, std430) writeonly buffer TracedHits { TracedHit hits[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= rays.length())
        return;
    const Ray ray = rays[i];
    Hit hit;
    if (intersectClosest(ray.origin, ray.direction, kInfinity, RayFilter(false, ray.fromSurface, kNoSurface, 0u), hit))
        hits[i] = TracedHit(hit.t, loadTriangle(hit.record).surface);
    else
        hits[i] = TracedHit(kInfinity, kNoSurface);
    tallyVisits();
}
