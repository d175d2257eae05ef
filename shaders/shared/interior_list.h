// The solids (KHR_materials_volume) that a path is in, by TriangleNormals::solid.
#ifndef LAVALIGHT_SHARED_INTERIOR_LIST_H
#define LAVALIGHT_SHARED_INTERIOR_LIST_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// In the order in which the path entered them, 16 bits each; 0: no more. lib/interior_list.glsl reads and writes it.
//
//             bits 31 to 16       15 to 0
//   outer   |  second           | first                            |
//   inner   |  fourth           | third                            |
//   notes   |  of lib/solids.glsl, 24 bits | entered without room |
struct InteriorList {
    uint outer;
    uint inner;
    uint notes;
};
SHARED_CONST uint kInteriorEntries = 4u;
SHARED_CONST uint kLastSolid = 0xffffu; // solids of higher numbers count as this one
SHARED_CONST uint kInteriorOverflowMask = 0xffu;

LAVALIGHT_SHARED_END

#endif
