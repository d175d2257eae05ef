// The accelerator "bvh8": a tree of eight quantised boxes a node (shared/bvh.h), and a stack for each ray.
// scene/intersect.glsl says what its two functions answer.
#ifndef LAVALIGHT_BVH8_ACCELERATOR_GLSL
#define LAVALIGHT_BVH8_ACCELERATOR_GLSL

#include "lib/math/constants.glsl"
#include "lib/math/ray_box.glsl"
#include "lib/math/ray_triangle.glsl"
#include "scene/bvh8/alpha_question.glsl"
#include "scene/bvh8/traversal_stack.glsl"
#include "scene/intersect.glsl"
#include "scene/triangle_record.glsl"
#include "shared/bindings.h"
#include "shared/bvh.h"

layout(set = 0, binding = BINDING_BVH_NODES) uniform utextureBuffer bvhNodes; // kNodeTexels a node

BvhNode loadNode(uint index) {
    int texel = int(index * kNodeTexels);
    uvec4 a = texelFetch(bvhNodes, texel);
    uvec4 b = texelFetch(bvhNodes, texel + 1);
    uvec4 c = texelFetch(bvhNodes, texel + 2);
    uvec4 d = texelFetch(bvhNodes, texel + 3);
    uvec4 e = texelFetch(bvhNodes, texel + 4);
    return BvhNode(uintBitsToFloat(a.xyz), a.w, BvhChildren(b.x, b.y, b.zw), uvec2[3](c.xy, c.zw, d.xy),
                   uvec2[3](d.zw, e.xy, e.zw));
}

uint childReference(BvhChildren children, uint slot) {
    uint content = (slot < 4u ? children.slots.x : children.slots.y) >> 8u * (slot & 3u);
    uint count = content >> kSlotCountShift & kSlotCountMask;
    uint offset = content & kSlotOffsetMask;
    return count == kSlotIsNode ? children.firstNode + offset
                                : kLeafBit | count << kLeafCountShift | (children.firstTriangle + offset);
}

// Takes a leaf's triangles that are hit before `nearest` for the nearest, or asks whether one lets the ray through.
bool intersectLeaf(ShearedRay ray, uint leaf, RayFilter ignored, inout AlphaQuestion question, inout NearestHit nearest) {
    uint first = leaf & kLeafFirstMask;
    uint end = first + ((leaf >> kLeafCountShift) & kLeafCountMask);
    bool found = false;
    for (uint i = first; i < end; ++i) {
        visited.triangles += kCountVisits ? 1u : 0u;
        TriangleRecord triangle = loadTriangle(i);
        TriangleHit candidate;
        if (!intersectTriangle(ray, triangle.v0, triangle.v1, triangle.v2, candidate) ||
            !comesFirst(candidate.t, triangle.surface, nearest.hit.t, nearest.surface) ||
            passesThrough(ignored, triangle, candidate.front))
            continue;
        if (sceneHas(kFeatureAlpha) && (triangle.material & kAlphaBit) != 0u) {
            askAlpha(Hit(candidate.t, i, candidate.barycentrics), first, question);
            continue;
        }
        nearest = NearestHit(Hit(candidate.t, i, candidate.barycentrics), triangle.surface);
        found = true;
    }
    return found;
}

// Takes the nearest of the siblings: a leaf is returned, of a node the children become the siblings at hand.
uint nextLeaf(SlabRay slab, float tMax, inout uint siblings, inout Stack stack) {
    visited.nodes += kCountVisits ? 1u : 0u;
    BvhNode node = loadNode(parentOf(siblings));
    MetBoxes met = intersectBoxes(slab, node, siblings & kAllSlots, tMax);
    siblings = siblings & ~kAllSlots | met.slots & ~(1u << met.nearest);
    uint nearest = met.slots != 0u ? childReference(node.children, met.nearest) : kEmptyLeaf;
    bool isNode = (nearest & kLeafBit) == 0u;
    if (isNode && anyWaits(siblings))
        push(stack, siblings);
    siblings = isNode ? childrenOf(nearest) : siblings;
    return isNode ? kEmptyLeaf : nearest;
}

// Traverses depth first, near children first. A step tests a node and then, whatever came of it, a leaf: rays that run in lockstep
// would otherwise pay for both and take one. Returns at the first hit if `any`.
bool traverse(vec3 origin, vec3 direction, RayFilter ignored, bool any, inout NearestHit nearest) {
    direction = withoutZeros(direction);
    SlabRay slab = slabRay(origin, direction);
    ShearedRay sheared = shearRay(origin, direction);
    Stack stack = emptyStack();
    uint siblings = childrenOf(0u);
    uint leaf = kEmptyLeaf;
    bool found = false;
    AlphaQuestion question = kNoQuestion;
    while (true) {
        while (stack.size < kStackRegisters && !question.isOpen) {
            if (!sceneHas(kFeatureAlpha) || leaf == kEmptyLeaf) {
                if (!anyWaits(siblings))
                    siblings = pop(stack);
                leaf = nextLeaf(slab, nearest.hit.t, siblings, stack);
            }
            found = intersectLeaf(sheared, leaf, ignored, question, nearest) || found;
            if (any && found)
                return true;
            if (question.isOpen)
                continue; // and then once more through this leaf
            question.passed = 0u;
            leaf = kEmptyLeaf;
            if (!anyWaits(siblings) && stack.size == 0u)
                break;
        }
        bool asked = question.isOpen;
        if (sceneHas(kFeatureAlpha)) {
            found = answerAlpha(leaf & kLeafFirstMask, ignored.alphaSeed, question, nearest) || found;
            if (any && found)
                return true;
        }
        if (!asked && stack.size == 0u && stack.blocks == 0u)
            return found;
        if (!asked || stack.size == kStackRegisters)
            exchange(stack);
    }
}

bool intersectClosest(vec3 origin, vec3 direction, float tMax, RayFilter ignored, out Hit hit) {
    NearestHit nearest = nothingBefore(tMax);
    bool found = traverse(origin, direction, ignored, false, nearest);
    hit = nearest.hit;
    return found;
}

bool intersectAny(vec3 origin, vec3 direction, float tMax, RayFilter ignored) {
    NearestHit nearest = nothingBefore(tMax);
    return traverse(origin, direction, ignored, true, nearest);
}

#endif
