// What a ray's traversal still has to visit: siblings that wait for nearer ones, and the stack of them.
#ifndef LAVALIGHT_TRAVERSAL_STACK_GLSL
#define LAVALIGHT_TRAVERSAL_STACK_GLSL

#include "shared/bvh.h"

// Children of one node that wait for nearer ones:   | node (24 bits) | a bit for each of its slots |
//
// Which of them is next, and whether any still lies before the hit, is for another test of the node's boxes to say. That
// takes more steps than to keep the distance and the order of those that wait, but shorter ones, of fewer registers: with
// a distance and a mask in order of octants bounce rays were 0.9 times as fast.
const uint kSlotBits = 8u;
const uint kAllSlots = 0xffu;

uint childrenOf(uint node) {
    return node << kSlotBits | kAllSlots;
}

uint parentOf(uint siblings) {
    return siblings >> kSlotBits;
}

bool anyWaits(uint siblings) {
    return (siblings & kAllSlots) != 0u;
}

// The newest eight entries lie in registers, newest first, older ones in memory, in blocks of four. lavapipe stores to
// memory lane by lane; with all entries there, bounce rays on 300k triangles were 0.75 times as fast.
struct Stack {
    uvec4 newest, older;
    uint size;   // in registers
    uint blocks; // in memory
};

const uint kStackRegisters = 8u;
uvec4 stackMemory[kMaxBvhLevels / 4u];

Stack emptyStack() {
    return Stack(uvec4(0u), uvec4(0u), 0u, 0u);
}

void push(inout Stack stack, uint siblings) {
    stack.older = uvec4(stack.newest.w, stack.older.xyz);
    stack.newest = uvec4(siblings, stack.newest.xyz);
    ++stack.size;
}

uint pop(inout Stack stack) {
    uint siblings = stack.newest.x;
    stack.newest = uvec4(stack.newest.yzw, stack.older.x);
    stack.older.xyz = stack.older.yzw;
    --stack.size;
    return siblings;
}

// Frees four registers that are full, or fills four when none is.
void exchange(inout Stack stack) {
    if (stack.size == kStackRegisters) {
        stackMemory[stack.blocks] = stack.older;
        ++stack.blocks;
    } else {
        --stack.blocks;
        stack.newest = stackMemory[stack.blocks];
    }
    stack.size = 4u;
}

#endif
