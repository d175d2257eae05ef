#version 460
// Says which rays that the host made meet anything, as connect asks of those of a wave: for benchmarks and tests.
#include "scene/visit_counts.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_SHADOW_RAYS, std430) readonly buffer ShadowRays { ShadowRay shadowRays[]; };
layout(set = 0, binding = BINDING_HITS, std430) writeonly buffer Occluded { uint occluded[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= shadowRays.length())
        return;
    const ShadowRay ray = shadowRays[i];
    const RayFilter ignored = RayFilter(false, ray.fromSurface, ray.toSurface, 0u);
    occluded[i] = intersectAny(ray.origin, ray.direction, 1.0, ignored) ? 1u : 0u;
    tallyVisits();
}
