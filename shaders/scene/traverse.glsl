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

// Shortens hit.t where one of a leaf's triangles is hit before it.
bool intersectLeaf(ShearedRay ray, uint leaf, bool cullBackFaces, inout Hit hit) {
    uint first = leaf & kLeafFirstMask;
    uint end = first + ((leaf >> kLeafCountShift) & kLeafCountMask);
    bool found = false;
    for (uint i = first; i < end; ++i) {
        LeafTriangle triangle = loadLeafTriangle(i);
        TriangleHit candidate;
        if (!intersectTriangle(ray, triangle.v0, triangle.v1, triangle.v2, hit.t, candidate))
            continue;
        if (cullBackFaces && !candidate.front && (triangle.material & kNeverCulledBit) == 0u)
            continue;
        hit = Hit(candidate.t, i, candidate.barycentrics);
        found = true;
    }
    return found;
}

// Depth first, near children first, the others' turn kept on a private stack. Returns at the first hit if `any`.
bool traverse(vec3 origin, vec3 direction, bool cullBackFaces, bool any, inout Hit hit) {
    direction = withoutZeros(direction);
    SlabRay slab = slabRay(origin, direction);
    ShearedRay sheared = shearRay(origin, direction);
    uint stack[kTraversalStackSize];
    uint size = 0u;
    uint current = 0u;
    bool found = false;
    while (true) {
        bool pop = true;
        if ((current & kLeafBit) != 0u) {
            found = intersectLeaf(sheared, current, cullBackFaces, hit) || found;
            if (any && found)
                return true;
        } else {
            BvhNode node = loadNode(current);
            vec4 enter, leave;
            intersectBoxes(slab, node, hit.t, enter, leave);
            vec4 t = mix(vec4(kInfinity), enter, lessThanEqual(enter, leave));
            uvec4 children = node.children;
            orderChildren(t, children);
            if (t.w < kInfinity)
                stack[size++] = children.w;
            if (t.z < kInfinity)
                stack[size++] = children.z;
            if (t.y < kInfinity)
                stack[size++] = children.y;
            current = children.x;
            pop = t.x == kInfinity;
        }
        if (pop) {
            if (size == 0u)
                return found;
            current = stack[--size];
        }
    }
}

// The nearest hit with 0 < t < tMax. cullBackFaces passes through the backs of single-sided triangles, as camera rays do.
// `direction` has a length near 1.
bool intersectClosest(vec3 origin, vec3 direction, float tMax, bool cullBackFaces, out Hit hit) {
    hit = Hit(tMax, 0u, vec2(0.0));
    return traverse(origin, direction, cullBackFaces, false, hit);
}

// Whether anything, from either side, lies at 0 < t < tMax.
bool intersectAny(vec3 origin, vec3 direction, float tMax) {
    Hit hit = Hit(tMax, 0u, vec2(0.0));
    return traverse(origin, direction, false, true, hit);
}

#endif
