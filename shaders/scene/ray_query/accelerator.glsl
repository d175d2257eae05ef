// The accelerator "ray_query": an acceleration structure that the device builds and traverses (VK_KHR_ray_query), with a
// graphics card's units for rays. A record is a triangle of the scene's numbering. The device proposes triangles, and our
// test decides (scene/proposed_hit.glsl).
#ifndef LAVALIGHT_RAY_QUERY_ACCELERATOR_GLSL
#define LAVALIGHT_RAY_QUERY_ACCELERATOR_GLSL

#extension GL_EXT_ray_query : require

#include "scene/intersect.glsl"
#include "scene/proposed_hit.glsl"
#include "shared/bindings.h"

layout(set = 0, binding = BINDING_TRIANGLE_STRUCTURE) uniform accelerationStructureEXT triangleStructure;

// One texel: a length in x, in units of the world, that no coordinate of the scene exceeds.
layout(set = 0, binding = BINDING_STRUCTURE_EXTENT) uniform utextureBuffer structureExtent;

const float kLongestRay = 3e38;
const float kSetBack = 1e-5; // of the largest coordinate

// Vulkan leaves open what a ray does that has no direction, or ends before it starts.
bool mayBeAsked(vec3 origin, vec3 direction, float tMax) {
    return isTraceable(origin, direction) && tMax > 0.0 && dot(direction, direction) > 0.0;
}

// How far before its start a ray sets out on the device, and how far behind its end it goes, in units of t: what lies at the
// start itself, such as a surface that coincides with the one there, is proposed as well. The device's test rounds by the
// size of coordinates, the origin's and the triangle's. Our own test leaves out what is behind.
float setBack(vec3 origin, vec3 direction) {
    const vec3 size = abs(origin);
    const float extent = uintBitsToFloat(texelFetch(structureExtent, 0).x);
    return kSetBack * max(max(max(size.x, size.y), size.z), extent) / length(direction);
}

// What to look for among the triangles that a ray meets.
const uint kNearest = 0u;   // the nearest, as the device sees it: it need not look beyond
const uint kAll = 1u;       // the nearest by our test, of all
const uint kFirstFound = 2u;

bool search(uint wanted, vec3 origin, float start, vec3 direction, float end, RayFilter ignored, inout NearestHit nearest) {
    const ShearedRay sheared = shearRay(origin, direction);
    rayQueryEXT query;
    const float back = setBack(origin, direction);
    rayQueryInitializeEXT(query, triangleStructure, gl_RayFlagsNoneEXT, 0xff, origin - back * direction, start, direction,
                          min(end + 2.0 * back, kLongestRay));
    bool found = false;
    while (rayQueryProceedEXT(query)) {
        const uint record = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
        const vec2 proposed = rayQueryGetIntersectionBarycentricsEXT(query, false);
        if (!takesProposed(sheared, record, proposed, ignored, nearest))
            continue;
        found = true;
        if (wanted == kNearest)
            rayQueryConfirmIntersectionEXT(query);
        if (wanted == kFirstFound)
            break;
    }
    return found;
}

// The device's order decides between triangles at nearly one distance only where ours does not: those around the first
// answer are looked at again.
bool intersectClosest(vec3 origin, vec3 direction, float tMax, RayFilter ignored, out Hit hit) {
    NearestHit nearest = nothingBefore(tMax);
    const bool found = mayBeAsked(origin, direction, tMax) &&
                       search(kNearest, origin, 0.0, direction, withMargin(tMax), ignored, nearest);
    if (found)
        search(kAll, origin, nearest.hit.t * (1.0 - kProposalMargin), direction, withMargin(nearest.hit.t), ignored,
               nearest);
    hit = nearest.hit;
    return found;
}

bool intersectAny(vec3 origin, vec3 direction, float tMax, RayFilter ignored) {
    NearestHit nearest = nothingBefore(tMax);
    return mayBeAsked(origin, direction, tMax) &&
           search(kFirstFound, origin, 0.0, direction, withMargin(tMax), ignored, nearest);
}

#endif
