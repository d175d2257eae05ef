// Notices solids (KHR_materials_volume) that overlap: the medium follows from the side of each hit alone, so that within both
// of two solids neither the refraction nor the colour is that of any medium. A solid is what one mesh bounds.
//
//       A .-------.
//   ------+---.---+----.---->    entered A, entered B from within A, left A (or B, then A): they overlap
//         '---+---' B  |
//             '--------'
//
// Only leaving shows that. Where solids touch, a path meets but one of the two surfaces, and where a mesh has a hole it leaves
// unseen: either way it enters B with A on its list, but does not come to leave A without having entered it once more, unless
// it turns back within B. Where the list proves wrong, the path starts another.
//
// Notes of the list:   | B: the solid entered last, 16 bits | unused, 6 | kSolids..., 2 | overflow, 8 |
#include "lib/interior_list.glsl"
#include "shared/wavefront.h"

const uint kSolidsApart = 0u;
const uint kSolidsNested = 1u;    // within A and B
const uint kSolidsInnerLeft = 2u; // was within both, and is in A
const uint kSolidsOverlap = 3u;   // left both: they do overlap

const uint kSolidsStateShift = 8u;
const uint kSolidsInnerShift = 16u;

uint solidsState(InteriorList list) {
    return list.notes >> kSolidsStateShift & 3u;
}

// A and B of the figure.
uint outerSolid(InteriorList list) {
    return interiorAt(list, 0u);
}

uint innerSolid(InteriorList list) {
    return list.notes >> kSolidsInnerShift;
}

InteriorList withNotes(InteriorList list, uint inner, uint state) {
    list.notes = interiorOverflow(list) | state << kSolidsStateShift | inner << kSolidsInnerShift;
    return list;
}

InteriorList onlyWithin(uint solid) {
    InteriorList list = kNoInterior;
    if (solid != 0u)
        list = enterInterior(list, solid);
    return list;
}

InteriorList enterSolid(InteriorList list, uint solid) {
    InteriorList entered;
    if (outerSolid(list) == 0u || solidsState(list) == kSolidsInnerLeft)
        entered = onlyWithin(solid);
    else
        entered = withNotes(enterInterior(list, solid), solidNumber(solid), kSolidsNested);
    return entered;
}

// throughBoth: whether the way since the last surface was longer than rounding errors, by which solids that touch overlap.
InteriorList leaveSolid(InteriorList list, uint solid, bool throughBoth) {
    const uint state = solidsState(list);
    const uint inner = innerSolid(list);
    InteriorList left = kNoInterior;
    if (state == kSolidsNested && !throughBoth)
        left = onlyWithin(inner);
    else if (state == kSolidsNested && solidNumber(solid) == inner)
        left = withNotes(leaveInterior(list, solid), inner, kSolidsInnerLeft);
    else if (state != kSolidsApart && solidNumber(solid) == outerSolid(list))
        left = withNotes(list, inner, kSolidsOverlap);
    return left;
}

// The list once the path is reflected.
InteriorList turnAmongSolids(InteriorList list) {
    InteriorList after = list;
    if (solidsState(list) == kSolidsNested)
        after = kNoInterior;
    return after;
}

// The list once the path has passed the boundary of `solid` (0: of none), into it or out of it; kSolidsOverlap stays.
InteriorList passSolid(InteriorList list, uint solid, bool enters, bool throughBoth) {
    InteriorList after = list;
    if (solidsState(list) != kSolidsOverlap && solid != 0u) {
        if (enters)
            after = enterSolid(list, solid);
        else
            after = leaveSolid(list, solid, throughBoth);
    }
    return after;
}

// The numbers of both in a word, for the ledger to name one pair of many. Never 0 where they overlap.
uint packOverlap(InteriorList list) {
    return outerSolid(list) << 16 | innerSolid(list);
}
