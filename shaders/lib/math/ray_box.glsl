// The slab test of a ray against the eight quantised child boxes of a node, free of false misses.
// Based on: Kay, Kajiya, "Ray Tracing Complex Scenes", 1986; quantised boxes after Ylitie, Karras, Laine, "Efficient
// Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", 2017.
#ifndef LAVALIGHT_RAY_BOX_GLSL
#define LAVALIGHT_RAY_BOX_GLSL

#include "lib/math/ray_direction.glsl"
#include "shared/bvh.h"

// Tolerance of the slab test, relative: 16 half units in the last place of a float (2^-24 each).
//
// A plane at origin + byte * step meets the ray at byte * (step / d) + (origin - o) / d. Let S and O be these two terms'
// factors as computed. Division is good to 2.5 units, every other operation to half a unit; together they are off by
// less than 8 half units of |O| and 8 of |t|. A triangle in the box is tested after its corners were moved and sheared,
// each rounded by at most 4 half units of its distance from the ray's origin along the main axis; the ray may meet the
// rounded triangle where it passes the box by as much. Let R be the largest distance from the ray's origin to the box
// along any axis: neither |O d| nor a distance |t d| that counts exceeds it. So planes move apart by 2 k R / |d|. Without
// it rays leak between neighbouring boxes where triangles share an edge in the plane between them.
const float kSlabTolerance = 16.0 / 16777216.0;

struct SlabRay {
    vec3 origin;
    vec3 inverse;   // 1 / direction
    vec3 tolerance; // tolerance of a plane's t, per unit of distance from the ray's origin to the box
    bvec3 backwards; // direction is negative
};

// `direction` comes from withoutZeros.
SlabRay slabRay(vec3 origin, vec3 direction) {
    vec3 inverse = 1.0 / direction;
    return SlabRay(origin, inverse, 2.0 * kSlabTolerance * abs(inverse), lessThan(direction, vec3(0.0)));
}

vec4 unpackBytes(uint packed) {
    ivec4 bytes = ivec4(packed, packed >> 8u, packed >> 16u, packed >> 24u) & 0xff;
    return vec4(bytes); // from signed integers: unsigned ones convert in several instructions on x86
}

// The larger or smaller of the floats by comparing their bits, which is right as long as one is not negative and leaves
// a negative number negative. On lavapipe a float's min() and max() take three instructions each for the sake of NaN.
ivec4 maxBits(vec4 a, vec4 b) {
    return max(floatBitsToInt(a), floatBitsToInt(b));
}

ivec4 minBits(vec4 a, vec4 b) {
    return min(floatBitsToInt(a), floatBitsToInt(b));
}

// At least as far as any plane of the node's boxes is from the ray's origin along any axis.
float farthestPlane(vec3 toOrigin, uvec3 exponents) {
    ivec3 size = floatBitsToInt(toOrigin) & 0x7fffffff;
    uint exponent = max(max(exponents.x, exponents.y), exponents.z);
    return intBitsToFloat(max(max(size.x, size.y), size.z)) + 255.0 * uintBitsToFloat(exponent << 23u);
}

// What the boxes of a node share: t of a plane is its byte * stepT + nearT where the ray enters, + farT where it leaves.
struct NodeSlabs {
    vec3 stepT;
    vec3 nearT;
    vec3 farT;
};

NodeSlabs nodeSlabs(SlabRay ray, BvhNode node) {
    uvec3 exponents = uvec3(node.exponents, node.exponents >> 8u, node.exponents >> 16u) & 0xffu;
    vec3 toOrigin = node.origin - ray.origin;
    vec3 originT = toOrigin * ray.inverse;
    vec3 slack = farthestPlane(toOrigin, exponents) * ray.tolerance;
    return NodeSlabs(uintBitsToFloat(exponents << 23u) * ray.inverse, originT - slack, originT + slack);
}

// Four boxes, whose planes are the bytes of one word each. A box's key sorts by where the ray enters: the bits of that
// distance, at least 0, of which the three lowest give way to the box's slot. With it goes the slot's bit. They are kMissed
// and 0 where the box is not asked for, or the ray has left it, or is beyond tMax, before it enters.
struct FourBoxes {
    uvec4 keys;
    uvec4 bits;
};

const uint kMissed = 0xffffffffu;
const uint kKeySlotMask = kBvhWidth - 1u;

FourBoxes intersectFour(NodeSlabs slabs, uvec3 enterPlanes, uvec3 leavePlanes, uint asked, float tMax, uvec4 slots) {
    vec4 enterX = unpackBytes(enterPlanes.x) * slabs.stepT.x + slabs.nearT.x;
    vec4 enterY = unpackBytes(enterPlanes.y) * slabs.stepT.y + slabs.nearT.y;
    vec4 enterZ = unpackBytes(enterPlanes.z) * slabs.stepT.z + slabs.nearT.z;
    vec4 leaveX = unpackBytes(leavePlanes.x) * slabs.stepT.x + slabs.farT.x;
    vec4 leaveY = unpackBytes(leavePlanes.y) * slabs.stepT.y + slabs.farT.y;
    vec4 leaveZ = unpackBytes(leavePlanes.z) * slabs.stepT.z + slabs.farT.z;
    ivec4 enter = max(maxBits(enterX, enterY), maxBits(enterZ, vec4(0.0)));
    ivec4 leave = min(minBits(leaveX, leaveY), minBits(leaveZ, vec4(tMax)));
    uvec4 bits = mix(uvec4(0u), uvec4(1u) << slots, lessThanEqual(enter, leave)) & asked;
    return FourBoxes(mix(uvec4(kMissed), uvec4(enter) & ~kKeySlotMask | slots, notEqual(bits, uvec4(0u))), bits);
}

// Which of a node's boxes a ray meets: a bit for each slot, and the one that it enters first, if any.
struct MetBoxes {
    uint slots;
    uint nearest;
};

// `asked` has a bit for each slot to test.
MetBoxes intersectBoxes(SlabRay ray, BvhNode node, uint asked, float tMax) {
    NodeSlabs slabs = nodeSlabs(ray, node);
    uvec2 enterX = ray.backwards.x ? node.upper[0] : node.lower[0];
    uvec2 enterY = ray.backwards.y ? node.upper[1] : node.lower[1];
    uvec2 enterZ = ray.backwards.z ? node.upper[2] : node.lower[2];
    uvec2 leaveX = ray.backwards.x ? node.lower[0] : node.upper[0];
    uvec2 leaveY = ray.backwards.y ? node.lower[1] : node.upper[1];
    uvec2 leaveZ = ray.backwards.z ? node.lower[2] : node.upper[2];
    FourBoxes low = intersectFour(slabs, uvec3(enterX.x, enterY.x, enterZ.x), uvec3(leaveX.x, leaveY.x, leaveZ.x), asked,
                                  tMax, uvec4(0u, 1u, 2u, 3u));
    FourBoxes high = intersectFour(slabs, uvec3(enterX.y, enterY.y, enterZ.y), uvec3(leaveX.y, leaveY.y, leaveZ.y), asked,
                                   tMax, uvec4(4u, 5u, 6u, 7u));
    uvec4 keys = min(low.keys, high.keys);
    uvec4 bits = low.bits | high.bits;
    return MetBoxes(bits.x | bits.y | bits.z | bits.w, min(min(keys.x, keys.y), min(keys.z, keys.w)) & kKeySlotMask);
}

#endif
