// Which solids (KHR_materials_volume) a path has entered, to notice those that overlap: the medium follows from the side of
// each hit alone, so that within both of two solids neither the refraction nor the colour is that of any medium. A solid is
// what one mesh bounds.
//
//       A .-------.
//   ------+---.---+----.---->    entered A, entered B from within A, left A (or B, then A): they overlap
//         '---+---' B  |
//             '--------'
//
// Only leaving shows that. Where solids touch, a path meets but one of the two surfaces, and where a mesh has a hole it leaves
// unseen: either way it enters B with A in mind, but does not come to leave A without having entered it once more, unless it
// turns back within B.
#include "shared/wavefront.h"

SolidsSeen enterSolid(SolidsSeen seen, uint solid) {
    const bool isAlone = seen.outer == 0u || seen.state == kSolidsInnerLeft;
    return isAlone ? SolidsSeen(solid, 0u, kSolidsApart) : SolidsSeen(seen.outer, solid, kSolidsNested);
}

// throughBoth: whether the way since the last surface was longer than rounding errors, by which solids that touch overlap.
SolidsSeen leaveSolid(SolidsSeen seen, uint solid, bool throughBoth) {
    SolidsSeen left = SolidsSeen(0u, 0u, kSolidsApart);
    if (seen.state == kSolidsNested && !throughBoth)
        left.outer = seen.inner;
    else if (seen.state == kSolidsNested && solid == seen.inner)
        left = SolidsSeen(seen.outer, seen.inner, kSolidsInnerLeft);
    else if (seen.state != kSolidsApart && solid == seen.outer)
        left = SolidsSeen(seen.outer, seen.inner, kSolidsOverlap);
    return left;
}

// What has been seen once the path is reflected.
SolidsSeen turnAmongSolids(SolidsSeen seen) {
    SolidsSeen after = seen;
    if (seen.state == kSolidsNested)
        after = SolidsSeen(0u, 0u, kSolidsApart);
    return after;
}

// What has been seen once the path has passed the boundary of `solid` (0: of none), into it or out of it; kSolidsOverlap stays.
SolidsSeen passSolid(SolidsSeen seen, uint solid, bool enters, bool throughBoth) {
    SolidsSeen after = seen;
    if (seen.state != kSolidsOverlap && solid != 0u)
        after = enters ? enterSolid(seen, solid) : leaveSolid(seen, solid, throughBoth);
    return after;
}

// Both numbers in a word, for the ledger to name one pair of many; those beyond 16 bits are cut. Never 0.
uint packOverlap(SolidsSeen seen) {
    return min(seen.outer, 0xffffu) << 16 | min(seen.inner, 0xffffu);
}
