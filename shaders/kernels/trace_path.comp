#version 460
// One vertex of one path, told in full: what the fused kernel does with it, for those who want to see. The host dispatches it
// vertex by vertex; range.bounce counts them.
#include "scene/traced_vertex.glsl"
#include "shared/bindings.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_RAYS, std430) buffer Rays { Ray rays[]; };
layout(set = 0, binding = BINDING_PATHS, std430) buffer Paths { Path paths[]; };
layout(set = 0, binding = BINDING_HITS, std430) writeonly buffer TracedOut { TracedVertex traced[]; };

void main() {
    if (gl_GlobalInvocationID.x > 0u)
        return;
    const uint slot = 0u;
    const uint bounce = range.bounce;
    Ray ray = rays[slot];
    Path path = paths[slot];
    if (bounce == 0u) { // no choice between a buffer's record and another: glslang makes invalid SPIR-V of it
        ray = cameraRayOf(slot);
        path = kNewPath;
    }
    const Hit hit = trace(slot, bounce, ray);
    NextRays next;
    TracedVertex v = traceVertex(hit, ray, slot, bounce, path, next);
    const bool arrives = next.wantsShadowRay && !isOccluded(next.shadow, slot, bounce);
    if (arrives)
        path.radiance += next.shadow.contribution;
    v.flags |= next.wantsShadowRay && !arrives ? kTracedOccluded : 0u;
    rays[slot] = next.ray;
    paths[slot] = path;
    traced[0] = v;
}
