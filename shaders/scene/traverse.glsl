// Rays against the scene: the closest hit, or whether there is any.
#ifndef LAVALIGHT_TRAVERSE_GLSL
#define LAVALIGHT_TRAVERSE_GLSL

#include "lib/math/constants.glsl"
#include "lib/math/ray_box.glsl"
#include "lib/math/ray_triangle.glsl"
#include "scene/alpha_question.glsl"
#include "scene/leaf_triangle.glsl"
#include "scene/traversal_stack.glsl"
#include "shared/bindings.h"
#include "shared/bvh.h"
#include "shared/frame.h"
#include "shared/trace.h"
#include "shared/wavefront.h"

layout(set = 0, binding = BINDING_BVH_NODES) uniform utextureBuffer bvhNodes; // kNodeTexels a node

// What this invocation visited, for kernels that ask.
layout(constant_id = CONSTANT_COUNT_VISITS) const bool kCountVisits = false;
VisitCounts visited = VisitCounts(0u, 0u);

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

// What a ray passes through. A triangle that a ray starts or ends on must not be hit there: no offset of the origin could
// prevent it without tearing holes, since the computed t of a grazing ray is off by the triangle's size times rounding.
struct RayFilter {
    bool cullBackFaces;   // the backs of single-sided triangles, as camera rays do
    uint firstTriangle;   // ids, or kNoTriangle
    uint secondTriangle;
    uint alphaSeed;       // of its decisions where surfaces may let it through: scene/alpha.glsl
};

bool passesThrough(RayFilter ignored, LeafTriangle triangle, bool front) {
    if (triangle.triangle == ignored.firstTriangle || triangle.triangle == ignored.secondTriangle)
        return true;
    return ignored.cullBackFaces && !front && (triangle.material & kNeverCulledBit) == 0u;
}

// Shortens hit.t where one of a leaf's triangles is hit before it, or asks whether one lets the ray through.
bool intersectLeaf(ShearedRay ray, uint leaf, RayFilter ignored, inout AlphaQuestion question, inout Hit hit) {
    uint first = leaf & kLeafFirstMask;
    uint end = first + ((leaf >> kLeafCountShift) & kLeafCountMask);
    bool found = false;
    for (uint i = first; i < end; ++i) {
        visited.triangles += kCountVisits ? 1u : 0u;
        LeafTriangle triangle = loadLeafTriangle(i);
        TriangleHit candidate;
        if (!intersectTriangle(ray, triangle.v0, triangle.v1, triangle.v2, hit.t, candidate) ||
            passesThrough(ignored, triangle, candidate.front))
            continue;
        if (sceneHas(kFeatureAlpha) && (triangle.material & kAlphaBit) != 0u) {
            askAlpha(Hit(candidate.t, i, candidate.barycentrics), first, question);
            continue;
        }
        hit = Hit(candidate.t, i, candidate.barycentrics);
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

// Depth first, near children first. A step tests a node and then, whatever came of it, a leaf: rays that run in lockstep
// would otherwise pay for both and take one. Returns at the first hit if `any`.
bool traverse(vec3 origin, vec3 direction, RayFilter ignored, bool any, inout Hit hit) {
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
                leaf = nextLeaf(slab, hit.t, siblings, stack);
            }
            found = intersectLeaf(sheared, leaf, ignored, question, hit) || found;
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
            found = answerAlpha(leaf & kLeafFirstMask, ignored.alphaSeed, question, hit) || found;
            if (any && found)
                return true;
        }
        if (!asked && stack.size == 0u && stack.blocks == 0u)
            return found;
        if (!asked || stack.size == kStackRegisters)
            exchange(stack);
    }
}

// The nearest hit with 0 < t < tMax. `direction` has a length near 1.
bool intersectClosest(vec3 origin, vec3 direction, float tMax, RayFilter ignored, out Hit hit) {
    hit = Hit(tMax, 0u, vec2(0.0));
    return traverse(origin, direction, ignored, false, hit);
}

// Whether anything, from either side, lies at 0 < t < tMax.
bool intersectAny(vec3 origin, vec3 direction, float tMax, RayFilter ignored) {
    Hit hit = Hit(tMax, 0u, vec2(0.0));
    return traverse(origin, direction, ignored, true, hit);
}

#endif
