// Rays against the scene: the closest hit, or whether there is any.
#ifndef LAVALIGHT_TRAVERSE_GLSL
#define LAVALIGHT_TRAVERSE_GLSL

#include "lib/constants.glsl"
#include "lib/ray_box.glsl"
#include "lib/ray_triangle.glsl"
#include "scene/leaf_triangle.glsl"
#include "shared/bindings.h"
#include "shared/bvh.h"
#include "shared/wavefront.h"

layout(set = 0, binding = BINDING_BVH_NODES) uniform usamplerBuffer bvhNodes; // kNodeTexels a node

BvhNode loadNode(uint index) {
    int texel = int(index * kNodeTexels);
    uvec4 a = texelFetch(bvhNodes, texel);
    uvec4 b = texelFetch(bvhNodes, texel + 1);
    uvec4 c = texelFetch(bvhNodes, texel + 2);
    uvec4 d = texelFetch(bvhNodes, texel + 3);
    return BvhNode(uintBitsToFloat(a.xyz), a.w, b, uint[6](c.x, c.y, c.z, c.w, d.x, d.y), uint[2](0u, 0u));
}

// Puts the nearer of two children first. A missed one lies at infinity.
void orderPair(inout float ta, inout float tb, inout uint a, inout uint b) {
    bool swap = tb < ta;
    float t = swap ? ta : tb;
    uint child = swap ? a : b;
    ta = swap ? tb : ta;
    a = swap ? b : a;
    tb = t;
    b = child;
}

// Five comparisons sort four.
void orderChildren(inout vec4 t, inout uvec4 children) {
    orderPair(t.x, t.y, children.x, children.y);
    orderPair(t.z, t.w, children.z, children.w);
    orderPair(t.x, t.z, children.x, children.z);
    orderPair(t.y, t.w, children.y, children.w);
    orderPair(t.y, t.z, children.y, children.z);
}

// What a ray passes through. A triangle that a ray starts or ends on must not be hit there: no offset of the origin could
// prevent it without tearing holes, since the computed t of a grazing ray is off by the triangle's size times rounding.
struct RayFilter {
    bool cullBackFaces;   // the backs of single-sided triangles, as camera rays do
    uint firstTriangle;   // ids, or kNoTriangle
    uint secondTriangle;
};

bool passesThrough(RayFilter ignored, LeafTriangle triangle, bool front) {
    if (triangle.triangle == ignored.firstTriangle || triangle.triangle == ignored.secondTriangle)
        return true;
    return ignored.cullBackFaces && !front && (triangle.material & kNeverCulledBit) == 0u;
}

// Shortens hit.t where one of a leaf's triangles is hit before it.
bool intersectLeaf(ShearedRay ray, uint leaf, RayFilter ignored, inout Hit hit) {
    uint first = leaf & kLeafFirstMask;
    uint end = first + ((leaf >> kLeafCountShift) & kLeafCountMask);
    bool found = false;
    for (uint i = first; i < end; ++i) {
        LeafTriangle triangle = loadLeafTriangle(i);
        TriangleHit candidate;
        if (!intersectTriangle(ray, triangle.v0, triangle.v1, triangle.v2, hit.t, candidate) ||
            passesThrough(ignored, triangle, candidate.front))
            continue;
        hit = Hit(candidate.t, i, candidate.barycentrics);
        found = true;
    }
    return found;
}

// Depth first, near children first. The others wait on a private stack with the distance at which the ray enters them,
// since a hit found meanwhile makes a tenth of them idle. A step tests a node and then, whatever came of it, a leaf: rays
// that run in lockstep would otherwise pay for both and take one. Returns at the first hit if `any`.
bool traverse(vec3 origin, vec3 direction, RayFilter ignored, bool any, inout Hit hit) {
    direction = withoutZeros(direction);
    SlabRay slab = slabRay(origin, direction);
    ShearedRay sheared = shearRay(origin, direction);
    uint stack[kTraversalStackSize];
    float stackEnter[kTraversalStackSize];
    uint size = 0u;
    uint current = 0u;
    bool found = false;
    while (true) {
        if ((current & kLeafBit) == 0u) {
            BvhNode node = loadNode(current);
            vec4 enter, leave;
            intersectBoxes(slab, node, hit.t, enter, leave);
            vec4 t = mix(vec4(kInfinity), enter, lessThanEqual(enter, leave));
            uvec4 children = node.children;
            orderChildren(t, children);
            if (t.w < kInfinity) {
                stack[size] = children.w;
                stackEnter[size++] = t.w;
            }
            if (t.z < kInfinity) {
                stack[size] = children.z;
                stackEnter[size++] = t.z;
            }
            if (t.y < kInfinity) {
                stack[size] = children.y;
                stackEnter[size++] = t.y;
            }
            current = t.x < kInfinity ? children.x : kEmptyLeaf;
        }
        if ((current & kLeafBit) != 0u) {
            found = intersectLeaf(sheared, current, ignored, hit) || found;
            if (any && found)
                return true;
            do {
                if (size == 0u)
                    return found;
                --size;
            } while (stackEnter[size] >= hit.t);
            current = stack[size];
        }
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
