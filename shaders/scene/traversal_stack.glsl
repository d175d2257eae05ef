// What a ray's traversal still has to visit: siblings that wait for nearer ones, and the stack of them.
#ifndef LAVALIGHT_TRAVERSAL_STACK_GLSL
#define LAVALIGHT_TRAVERSAL_STACK_GLSL

#include "lib/ray_box.glsl"
#include "shared/bvh.h"

// Children of one node that wait for nearer ones.
//
//   waiting:  | distance to the next: the upper 24 bits of a float | a 1 and their numbers, two bits each, the next lowest |
struct Siblings {
    uint parent;
    uint waiting;
};

const uint kNumbersMask = 0xffu;
const uint kNobody = 1u; // by its numbers

bool anyWaits(Siblings siblings) {
    return (siblings.waiting & kNumbersMask) != kNobody;
}

// Whether one waits whose box begins before t. The distance is that of the first to wait, also once that one is gone.
bool anyWaitsBefore(Siblings siblings, float t) {
    bool near = (siblings.waiting & ~kNumbersMask) < floatBitsToUint(t);
    return near && anyWaits(siblings);
}

// All but the nearest, by sorted keys.
Siblings siblingsOfNearest(uint parent, uvec4 keys) {
    uint numbers = keys.w != kMissed ? kNobody << 2u | (keys.w & 3u) : kNobody;
    numbers = keys.z != kMissed ? numbers << 2u | (keys.z & 3u) : numbers;
    numbers = keys.y != kMissed ? numbers << 2u | (keys.y & 3u) : numbers;
    return Siblings(parent, (keys.y & ~kNumbersMask) | numbers);
}

// The number of the next, which waits no longer.
uint takeNext(inout Siblings siblings) {
    uint number = siblings.waiting & 3u;
    siblings.waiting = (siblings.waiting & ~kNumbersMask) | (siblings.waiting & kNumbersMask) >> 2u;
    return number;
}

// The newest eight entries lie in registers, newest first, older ones in memory, in blocks of four. lavapipe stores to
// memory lane by lane; with all entries there, bounce rays on 300k triangles were 0.75 times as fast.
struct Stack {
    uvec4 parents, olderParents;
    uvec4 waiting, olderWaiting;
    uint size;   // in registers
    uint blocks; // in memory
};

const uint kStackRegisters = 8u;
uvec4 stackParents[kMaxBvhLevels / 4u];
uvec4 stackWaiting[kMaxBvhLevels / 4u];

Stack emptyStack() {
    return Stack(uvec4(0u), uvec4(0u), uvec4(kNobody), uvec4(kNobody), 0u, 0u);
}

void push(inout Stack stack, Siblings siblings) {
    stack.olderParents = uvec4(stack.parents.w, stack.olderParents.xyz);
    stack.parents = uvec4(siblings.parent, stack.parents.xyz);
    stack.olderWaiting = uvec4(stack.waiting.w, stack.olderWaiting.xyz);
    stack.waiting = uvec4(siblings.waiting, stack.waiting.xyz);
    ++stack.size;
}

Siblings pop(inout Stack stack) {
    Siblings siblings = Siblings(stack.parents.x, stack.waiting.x);
    stack.parents = uvec4(stack.parents.yzw, stack.olderParents.x);
    stack.olderParents.xyz = stack.olderParents.yzw;
    stack.waiting = uvec4(stack.waiting.yzw, stack.olderWaiting.x);
    stack.olderWaiting.xyz = stack.olderWaiting.yzw;
    --stack.size;
    return siblings;
}

// Frees four registers that are full, or fills four when none is.
void exchange(inout Stack stack) {
    if (stack.size == kStackRegisters) {
        stackParents[stack.blocks] = stack.olderParents;
        stackWaiting[stack.blocks] = stack.olderWaiting;
        ++stack.blocks;
    } else {
        --stack.blocks;
        stack.parents = stackParents[stack.blocks];
        stack.waiting = stackWaiting[stack.blocks];
    }
    stack.size = 4u;
}

#endif
