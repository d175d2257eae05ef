#version 460
// What the host does with a triangle that Embree proposes. No device runs this: it is compiled so that edits of the code
// that it shares with the host are noticed.
#include "scene/path_rays.glsl"
#include "scene/proposed_hit.glsl"

layout(local_size_x = 1) in;
layout(set = 0, binding = BINDING_HITS, std430) buffer Hits { Hit hits[]; };
layout(set = 0, binding = BINDING_RAYS, std430) readonly buffer Rays { Ray rays[]; };

void main() {
    const Ray ray = rays[0];
    NearestHit nearest = nothingBefore(withMargin(endOf(0u, ray)));
    const ShearedRay sheared = shearRay(ray.origin, ray.direction);
    if (takesProposed(sheared, hits[0].record, hits[0].barycentrics, filterOf(0u, 0u, ray), nearest))
        hits[0] = nearest.hit;
}
