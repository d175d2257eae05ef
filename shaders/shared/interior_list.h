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
//   notes   |  touching solid   | flags, below                     |
struct InteriorList {
    uint outer;
    uint inner;
    uint notes;
};
SHARED_CONST uint kInteriorEntries = 4u;
SHARED_CONST uint kLastSolid = 0xffffu; // solids of higher numbers count as this one

// Notes.
SHARED_CONST uint kInteriorOverflowMask = 0xffu;  // solids that were entered without room
SHARED_CONST uint kInteriorWasCrowded = 0x100u;   // there was no room for a solid
SHARED_CONST uint kInteriorIsCounted = 0x200u;    // the tally has this path among the crowded ones
SHARED_CONST uint kInteriorPassed = 0x400u;       // the ray has passed boundaries that are no vertices
SHARED_CONST uint kInteriorEntersTouching = 0x800u; // the ray's end is a boundary of the touching solid, too: it enters it
SHARED_CONST uint kInteriorTouchingShift = 16u;   // the touching solid, or 0

LAVALIGHT_SHARED_END

#endif
