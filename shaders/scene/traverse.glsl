// Rays against the scene: the closest hit, or whether there is any.
#ifndef LAVALIGHT_TRAVERSE_GLSL
#define LAVALIGHT_TRAVERSE_GLSL

#include "lib/constants.glsl"
#include "lib/ray_box.glsl"
#include "lib/ray_triangle.glsl"
#include "scene/alpha_question.glsl"
#include "scene/leaf_triangle.glsl"
#include "scene/traversal_stack.glsl"
#include "shared/bindings.h"
#include "shared/bvh.h"
#include "shared/frame.h"
#include "shared/trace.h"
#include "shared/wavefront.h"

layout(set = 0, binding = BINDING_BVH_NODES) uniform usamplerBuffer bvhNodes; // kNodeTexels a node

// What this invocation visited, for kernels that ask.
layout(constant_id = CONSTANT_COUNT_VISITS) const bool kCountVisits = false;
VisitCounts visited = VisitCounts(0u, 0u);

BvhNode loadNode(uint index) {
    int texel = int(index * kNodeTexels);
    uvec4 a = texelFetch(bvhNodes, texel);
    uvec4 b = texelFetch(bvhNodes, texel + 1);
    uvec4 c = texelFetch(bvhNodes, texel + 2);
    uvec4 d = texelFetch(bvhNodes, texel + 3);
    return BvhNode(uintBitsToFloat(a.xyz), a.w, b, uint[6](c.x, c.y, c.z, c.w, d.x, d.y), uint[2](0u, 0u));
}

uvec4 loadChildren(uint node) {
    return texelFetch(bvhNodes, int(node * kNodeTexels) + 1);
}

uint childReference(uvec4 children, uint number) {
    return number == 0u ? children.x : number == 1u ? children.y : number == 2u ? children.z : children.w;
}

void orderPair(inout uint a, inout uint b) {
    uint smaller = min(a, b);
    b = max(a, b);
    a = smaller;
}

// Five comparisons sort four.
void order(inout uvec4 keys) {
    orderPair(keys.x, keys.y);
    orderPair(keys.z, keys.w);
    orderPair(keys.x, keys.z);
    orderPair(keys.y, keys.w);
    orderPair(keys.y, keys.z);
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

// Depth first, near children first. A step tests a node and then, whatever came of it, a leaf: rays that run in lockstep
// would otherwise pay for both and take one. Returns at the first hit if `any`.
bool traverse(vec3 origin, vec3 direction, RayFilter ignored, bool any, inout Hit hit) {
    direction = withoutZeros(direction);
    SlabRay slab = slabRay(origin, direction);
    ShearedRay sheared = shearRay(origin, direction);
    Stack stack = emptyStack();
    Siblings siblings = Siblings(0u, kNobody);
    uint current = 0u; // a node, a leaf, or, as an empty leaf, nothing
    bool found = false;
    AlphaQuestion question = kNoQuestion;
    while (true) {
        while (stack.size < kStackRegisters && !question.isOpen) {
            if ((current & kLeafBit) == 0u) {
                visited.nodes += kCountVisits ? 1u : 0u;
                BvhNode node = loadNode(current);
                uvec4 keys = intersectBoxes(slab, node, hit.t);
                order(keys);
                if (keys.x != kMissed && anyWaits(siblings))
                    push(stack, siblings);
                if (keys.x != kMissed)
                    siblings = siblingsOfNearest(current, keys);
                current = keys.x != kMissed ? childReference(node.children, keys.x & 3u) : kEmptyLeaf;
            }
            if ((current & kLeafBit) != 0u) {
                found = intersectLeaf(sheared, current, ignored, question, hit) || found;
                if (any && found)
                    return true;
                if (question.isOpen)
                    continue; // and then once more through this leaf
                question.passed = 0u;
                while (!anyWaitsBefore(siblings, hit.t) && stack.size > 0u)
                    siblings = pop(stack);
                current = kEmptyLeaf;
                if (!anyWaitsBefore(siblings, hit.t))
                    break;
                current = childReference(loadChildren(siblings.parent), takeNext(siblings));
            }
        }
        bool asked = question.isOpen;
        if (sceneHas(kFeatureAlpha)) {
            found = answerAlpha(current & kLeafFirstMask, ignored.alphaSeed, question, hit) || found;
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
