// A vertex of a path told in full, for those who want to see.
#include "scene/path_rays.glsl"
#include "scene/scatter.glsl"
#include "shared/traced_path.h"

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

// What scatter() does with the vertex; whether light arrives by the shadow ray is left open.
TracedVertex traceVertex(Hit hit, Ray ray, uint slot, uint bounce, inout Path path, out NextRays next) {
    TracedVertex v = describe(ray, hit);
    const vec3 before = path.radiance;
    v.throughput = path.throughput;
    next = scatter(hit, ray, slot, bounce, path);
    v.emitted = path.radiance - before;
    v.direct = next.wantsShadowRay ? next.shadow.contribution : vec3(0.0);
    v.direction = next.goesOn || next.survival < 1.0 ? next.ray.direction : vec3(0.0);
    v.pdf = path.bsdfPdf;
    v.survival = next.survival;
    v.flags |= next.wantsShadowRay ? kTracedShadowRay : 0u;
    v.flags |= next.goesOn ? kTracedGoesOn : 0u;
    v.flags |= next.isCut ? kTracedCut : 0u;
    v.flags |= isCaught(path) ? kTracedCaught : 0u;
    return v;
}
