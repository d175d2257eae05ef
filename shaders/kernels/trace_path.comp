#version 460
// One vertex of one path, told in full: what the fused kernel does with it, for those who want to see. The host dispatches it
// vertex by vertex; range.bounce counts them.
#include "scene/path_rays.glsl"
#include "scene/path_vertex.glsl"
#include "shared/bindings.h"
#include "shared/traced_path.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_RAYS, std430) buffer Rays { Ray rays[]; };
layout(set = 0, binding = BINDING_PATHS, std430) buffer Paths { Path paths[]; };
layout(set = 0, binding = BINDING_HITS, std430) writeonly buffer TracedOut { TracedVertex traced[]; };

TracedVertex describe(Ray ray, Hit hit) {
    TracedVertex v;
    v.t = hit.t;
    v.position = hit.t == kInfinity ? ray.direction : ray.origin + hit.t * ray.direction;
    v.surface = kNoSurface;
    v.material = 0u;
    v.flags = 0u;
    if (hit.t != kInfinity) {
        const TriangleRecord triangle = loadTriangle(hit.record);
        v.surface = triangle.surface;
        v.material = triangle.material & kMaterialMask;
        v.flags = makeInteraction(hit, -ray.direction).isFront ? kTracedFront : 0u;
    }
    return v;
}

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
    const vec3 before = path.radiance;
    const Hit hit = trace(slot, bounce, ray);
    TracedVertex v = describe(ray, hit);
    v.throughput = path.throughput;
    const NextRays next = scatter(hit, ray, slot, bounce, path);
    v.emitted = path.radiance - before;
    v.direct = next.wantsShadowRay ? next.shadow.contribution : vec3(0.0);
    v.direction = next.goesOn || next.survival < 1.0 ? next.ray.direction : vec3(0.0);
    v.pdf = path.bsdfPdf;
    v.survival = next.survival;
    const bool arrives = next.wantsShadowRay && !isOccluded(next.shadow, slot, bounce);
    if (arrives)
        path.radiance += next.shadow.contribution;
    v.flags |= next.wantsShadowRay ? kTracedShadowRay : 0u;
    v.flags |= next.wantsShadowRay && !arrives ? kTracedOccluded : 0u;
    v.flags |= next.goesOn ? kTracedGoesOn : 0u;
    v.flags |= next.isCut ? kTracedCut : 0u;
    rays[slot] = next.ray;
    paths[slot] = path;
    traced[0] = v;
}
