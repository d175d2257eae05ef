#version 460
// One vertex of one path, told in full: what the schedule "hosted" does with it, but for the rounding of kernels of a class. The
// host traces its rays. A dispatch of no records starts the path; another one takes the vertex where the ray has met the scene.
#include "scene/traced_vertex.glsl"
#include "shared/bindings.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_RAYS, std430) buffer Rays { Ray rays[]; };
layout(set = 0, binding = BINDING_PATHS, std430) buffer Paths { Path paths[]; };
layout(set = 0, binding = BINDING_RECORDS_IN, std430) readonly buffer Hits { Hit hits[]; };
layout(set = 0, binding = BINDING_SHADOW_RAYS, std430) writeonly buffer ShadowRays { ShadowRay shadowRays[]; };
layout(set = 0, binding = BINDING_HITS, std430) writeonly buffer TracedOut { TracedVertex traced[]; };

void main() {
    if (gl_GlobalInvocationID.x > 0u)
        return;
    const uint slot = 0u;
    if (range.recordCount == 0u) {
        rays[slot] = cameraRayOf(slot);
        paths[slot] = kNewPath;
        return;
    }
    Path path = paths[slot];
    NextRays next;
    traced[0] = traceVertex(hits[slot], rays[slot], slot, range.bounce, path, next);
    shadowRays[slot] = next.shadow;
    rays[slot] = next.ray;
    paths[slot] = path;
}
