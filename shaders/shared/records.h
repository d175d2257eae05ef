// Paths of the schedule "hosted" between the host, which traces their rays, and the kernels, which shade.
#ifndef LAVALIGHT_SHARED_RECORDS_H
#define LAVALIGHT_SHARED_RECORDS_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// A record is 16 bytes in each plane of a buffer. The host writes the first buffer for
// the kernels, and they write the second for the host: no invocation reads what another, or it itself, writes.
//
//   plane         x, y, z                 w
//   direction     direction of the ray    cosine at its origin
//   throughput    throughput              pdf of the BSDF
//   origin        origin of the ray       slot and flags
//   hit           t, record, b1           b2                  for the kernels alone
//   shadow        shadow ray's direction  surface that it ends on   for the host alone, as the next two
//   contribution  what it adds            -
//   emitted       what the vertex emits   -
//   state         etaScale, receiver, -   -                   with kRecordState
//   shadow origin origin of a shadow ray  -                   for the host, with kRecordShadowOrigin; else that of the next ray
//   interior      outer, inner, notes     -                   with kRecordInterior
SHARED_CONST uint kPlaneDirection = 0u;
SHARED_CONST uint kPlaneThroughput = 1u;
SHARED_CONST uint kPlaneOrigin = 2u;
SHARED_CONST uint kPlaneHit = 3u;    // of the first buffer
SHARED_CONST uint kPlaneShadow = 3u; // of the second
SHARED_CONST uint kPlaneState = 4u;
SHARED_CONST uint kPlaneInterior = 5u;
SHARED_CONST uint kPlanesIn = 6u; // of the first buffer
SHARED_CONST uint kPlaneContribution = 6u;
SHARED_CONST uint kPlaneEmitted = 7u;
SHARED_CONST uint kPlaneShadowOrigin = 8u;
SHARED_CONST uint kPlanesOut = 9u; // of the second

// Bits of CONSTANT_RECORD_PLANES: planes that not every scene needs.
SHARED_CONST uint kRecordState = 1u;        // rays remember their receiver, or etaScale changes
SHARED_CONST uint kRecordShadowOrigin = 2u; // a vertex may send its two rays to different sides
SHARED_CONST uint kRecordInterior = 4u;     // paths keep a list of solids

SHARED_CONST uint kRecordSlotMask = 0xffffffu;
SHARED_CONST uint kRecordGoesOn = 0x1000000u;
SHARED_CONST uint kRecordHasShadowRay = 0x2000000u;
SHARED_CONST uint kRecordEmits = 0x4000000u;
SHARED_CONST uint kRecordIsCaught = 0x10000000u; // the path is over, and becomes kCaught with the contribution as its throughput
SHARED_CONST uint kRecordOnSurface = 0x8000000u; // rays start on the surface that was hit: they ignore it

// Keeps planes from starting a power of two apart, where a record's parts would compete for one set of a cache.
SHARED_CONST uint kPlanePadding = 148u; // records

// Records from one plane to the next.
SHARED_FUNCTION uint planeStride(uint waveSize) {
    return waveSize + kPlanePadding;
}

LAVALIGHT_SHARED_END

#endif
