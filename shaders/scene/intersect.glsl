// Rays against the scene: the closest hit, or whether there is any. Kernels call these two functions; the accelerator that
// the last line includes implements them, and src/kernels/accelerator_name.h says which one that is.
//
// Every accelerator keeps to three rules, so that a film does not depend on how it was built: it heeds the RayFilter; of
// triangles at equal t the one of the lowest surface is hit (comesFirst); and a surface with alpha answers for itself
// (letsThrough in scene/alpha.glsl), whatever was met before.
#ifndef LAVALIGHT_INTERSECT_GLSL
#define LAVALIGHT_INTERSECT_GLSL

#include "scene/triangle_record.glsl"
#include "shared/frame.h"
#include "shared/trace.h"
#include "shared/wavefront.h"

// What a ray passes through. A triangle that a ray starts or ends on must not be hit there: no offset of the origin could
// prevent it without tearing holes, since the computed t of a grazing ray is off by the triangle's size times rounding.
struct RayFilter {
    bool cullBackFaces;      // the backs of single-sided triangles, as camera rays do
    SurfaceId firstSurface;  // or kNoSurface
    SurfaceId secondSurface;
    uint alphaSeed;          // of its decisions where surfaces may let it through: scene/alpha.glsl
};

// The nearest hit with 0 < t < tMax. `direction` has a length near 1.
bool intersectClosest(vec3 origin, vec3 direction, float tMax, RayFilter ignored, out Hit hit);

// Whether anything, from either side, lies at 0 < t < tMax.
bool intersectAny(vec3 origin, vec3 direction, float tMax, RayFilter ignored);

bool passesThrough(RayFilter ignored, TriangleRecord triangle, bool front) {
    if (isSameSurface(triangle.surface, ignored.firstSurface) || isSameSurface(triangle.surface, ignored.secondSurface))
        return true;
    return ignored.cullBackFaces && !front && (triangle.material & kNeverCulledBit) == 0u;
}

bool comesFirst(float t, SurfaceId surface, float otherT, SurfaceId other) {
    return t < otherT || (t == otherT && precedes(surface, other));
}

// What this invocation visited, for kernels that ask.
layout(constant_id = CONSTANT_COUNT_VISITS) const bool kCountVisits = false;
VisitCounts visited = VisitCounts(0u, 0u);

#include "scene/accelerator.glsl"

#endif
