// What the kernels that trace given rays (trace_closest, trace_any) answer.
#ifndef LAVALIGHT_SHARED_TRACE_H
#define LAVALIGHT_SHARED_TRACE_H

#include "shared/surface_id.h"
#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

struct TracedHit {
    float t;       // infinite: nothing was hit
    SurfaceId surface; // kNoSurface: nothing was hit
};

// What all rays together visited, if the kernel counts.
struct VisitCounts {
    uint nodes;
    uint triangles;
};

LAVALIGHT_SHARED_END

#endif
