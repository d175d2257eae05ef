// What the kernels trace_path and hosted/trace_path tell of one vertex of a path.
#ifndef LAVALIGHT_SHARED_TRACED_PATH_H
#define LAVALIGHT_SHARED_TRACED_PATH_H

#include "shared/surface_id.h"
#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

struct TracedVertex {
    vec3 position; // point of the hit; direction, where nothing was hit
    float t;       // distance from the vertex before; infinite: nothing was hit
    vec3 throughput; // throughput of the path before this vertex
    SurfaceId surface; // or kNoSurface
    vec3 emitted; // what the pixel got from this vertex's own light, or the environment's
    uint material;
    vec3 direct; // what NEE brings if its shadow ray arrives
    uint flags;  // kTraced...
    vec3 direction; // direction in which the path goes on, or would have but for roulette; else 0
    float pdf;      // density of the direction per solid angle, as MIS takes it; 0: delta lobe
    float survival; // probability that roulette left it; 1: there was none
    uint unused[3];
};
SHARED_CONST uint kTracedShadowRay = 1u; // NEE sent one
SHARED_CONST uint kTracedOccluded = 2u;  // and something was in its way
SHARED_CONST uint kTracedGoesOn = 4u;
SHARED_CONST uint kTracedCut = 8u; // ended by --max-bounces
SHARED_CONST uint kTracedFront = 16u; // the front of the triangle was hit
SHARED_CONST uint kTracedCaught = 32u; // nothing was hit but the ground that catches shadows

LAVALIGHT_SHARED_END

#endif
