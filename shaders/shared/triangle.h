// A triangle as accelerators and shading read it.
#ifndef LAVALIGHT_SHARED_TRIANGLE_H
#define LAVALIGHT_SHARED_TRIANGLE_H

#include "shared/surface_id.h"
#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// 48 bytes, three texels. Front: counter-clockwise. An accelerator keeps the records in an order of its own, in which a
// triangle may occur more than once.
struct TriangleRecord {
    vec3 v0;
    SurfaceId surface;
    vec3 v1;
    uint emitter; // or kNoEmitter
    vec3 v2;
    uint material; // index and flags: shared/scene.h
};
SHARED_CONST uint kTriangleTexels = 3u;

SHARED_CONST uint kNoEmitter = 0xffffffffu;
SHARED_CONST uint kNeverCulledBit = 0x80000000u; // its back face is seen by camera rays too (double sided)

// Index among the emitters of what shines there, or kNoEmitter.
SHARED_FUNCTION uint emitterOf(TriangleRecord triangle) {
    return triangle.emitter;
}

LAVALIGHT_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(lavalight::TriangleRecord) == 16 * lavalight::kTriangleTexels);
#endif

#endif
