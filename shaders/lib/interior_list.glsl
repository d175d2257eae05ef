// The list of the solids that a path is in: a stack that may also lose entries from its middle.
#ifndef LAVALIGHT_INTERIOR_LIST_GLSL
#define LAVALIGHT_INTERIOR_LIST_GLSL

#include "shared/interior_list.h"

const InteriorList kNoInterior = InteriorList(0u, 0u, 0u);

uint solidNumber(uint solid) {
    return min(solid, kLastSolid);
}

// Entry i, below kInteriorEntries; 0 beyond the last.
uint interiorAt(InteriorList list, uint i) {
    return (i < 2u ? list.outer : list.inner) >> 16u * (i & 1u) & 0xffffu;
}

uint interiorCount(InteriorList list) {
    const uint outer = (list.outer != 0u ? 1u : 0u) + (list.outer > 0xffffu ? 1u : 0u);
    return outer + (list.inner != 0u ? 1u : 0u) + (list.inner > 0xffffu ? 1u : 0u);
}

// How many solids it was in with no room for them.
uint interiorOverflow(InteriorList list) {
    return list.notes & kInteriorOverflowMask;
}

bool interiorContains(InteriorList list, uint solid) {
    const uint number = solidNumber(solid);
    bool found = false;
    for (uint i = 0u; i < kInteriorEntries; ++i)
        found = found || interiorAt(list, i) == number;
    return found && number != 0u;
}

// The solid, not 0, becomes the last entry.
InteriorList enterInterior(InteriorList list, uint solid) {
    const uint count = interiorCount(list);
    if (count < 2u)
        list.outer |= solidNumber(solid) << 16u * count;
    else if (count < kInteriorEntries)
        list.inner |= solidNumber(solid) << 16u * (count - 2u);
    else if (interiorOverflow(list) < kInteriorOverflowMask)
        list.notes = list.notes + 1u | kInteriorWasCrowded;
    return list;
}

// The solid's last entry goes, and those behind it move up. One that is not on the list is taken for one that had no room.
InteriorList leaveInterior(InteriorList list, uint solid) {
    uvec4 entries = uvec4(interiorAt(list, 0u), interiorAt(list, 1u), interiorAt(list, 2u), interiorAt(list, 3u));
    const bvec4 isIt = equal(entries, uvec4(solidNumber(solid)));
    if (isIt.w)
        entries = uvec4(entries.xyz, 0u);
    else if (isIt.z)
        entries = uvec4(entries.xyw, 0u);
    else if (isIt.y)
        entries = uvec4(entries.xzw, 0u);
    else if (isIt.x)
        entries = uvec4(entries.yzw, 0u);
    else if (interiorOverflow(list) > 0u)
        --list.notes;
    list.outer = entries.x | entries.y << 16u;
    list.inner = entries.z | entries.w << 16u;
    return list;
}

// The list once the path has passed the boundary of a solid, 0: of none. Leaving one that was never entered changes nothing.
InteriorList crossed(InteriorList list, uint solid, bool enters) {
    InteriorList after = list;
    if (solid != 0u && enters)
        after = enterInterior(list, solid);
    else if (solid != 0u && (interiorContains(list, solid) || interiorOverflow(list) > 0u))
        after = leaveInterior(list, solid);
    return after;
}

// The solid whose medium fills the place: of those on the list the lowest number, which is the smallest body. 0: none. It is
// a function of the set alone, so that all paths agree about it.
uint solidAround(InteriorList list) {
    uint lowest = 0u;
    for (uint i = 0u; i < kInteriorEntries; ++i) {
        const uint number = interiorAt(list, i);
        lowest = number != 0u && (lowest == 0u || number < lowest) ? number : lowest;
    }
    return lowest;
}

// Notes that the boundary at the ray's end is one of `solid`, too.
InteriorList withTouching(InteriorList list, uint solid, bool enters) {
    list.notes |= solidNumber(solid) << kInteriorTouchingShift | (enters ? kInteriorEntersTouching : 0u);
    return list;
}

uint touchingSolid(InteriorList list) {
    return list.notes >> kInteriorTouchingShift;
}

// The list without what it notes of one ray.
InteriorList withoutRayNotes(InteriorList list) {
    list.notes &= kInteriorOverflowMask | kInteriorWasCrowded | kInteriorIsCounted;
    return list;
}

// The list beyond the boundary of `solid`, and of the one that touches it there.
InteriorList beyondBoundary(InteriorList list, uint solid, bool enters) {
    const InteriorList after = crossed(list, solid, enters);
    return withoutRayNotes(crossed(after, touchingSolid(list), (list.notes & kInteriorEntersTouching) != 0u));
}

#endif
