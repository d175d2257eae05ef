// The slab test of a ray against the four quantised child boxes of a node, free of false misses.
// Based on: Kay, Kajiya, "Ray Tracing Complex Scenes", 1986; quantised boxes after Ylitie, Karras, Laine, "Efficient
// Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", 2017.
#ifndef LAVALIGHT_RAY_BOX_GLSL
#define LAVALIGHT_RAY_BOX_GLSL

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

// Smallest component of a direction: keeps quotients finite with coordinates up to kMaxCoordinate. All tests of a ray use
// the same, so changed, direction.
const float kSmallestDirection = 1e-18;

struct SlabRay {
    vec3 origin;
    vec3 inverse;   // 1 / direction
    vec3 tolerance; // of a plane's t, per unit of distance from the ray's origin to the box
    bvec3 backwards; // direction is negative
};

vec3 withoutZeros(vec3 direction) {
    uvec3 sign = floatBitsToUint(direction) & 0x80000000u;
    vec3 smallest = uintBitsToFloat(floatBitsToUint(vec3(kSmallestDirection)) | sign);
    return mix(direction, smallest, lessThan(abs(direction), vec3(kSmallestDirection)));
}

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

// A key for each of the four boxes, sorting by where the ray enters it, at least 0: the bits of that distance, of which the
// two lowest give way to the box's number; kMissed where the ray has left the box, or is beyond tMax, before it enters.
const uint kMissed = 0xffffffffu;
uvec4 intersectBoxes(SlabRay ray, BvhNode node, float tMax) {
    uvec3 exponents = uvec3(node.exponents, node.exponents >> 8u, node.exponents >> 16u) & 0xffu;
    vec3 toOrigin = node.origin - ray.origin;
    vec3 stepT = uintBitsToFloat(exponents << 23u) * ray.inverse;
    vec3 originT = toOrigin * ray.inverse;
    vec3 slack = farthestPlane(toOrigin, exponents) * ray.tolerance;
    vec3 nearT = originT - slack;
    vec3 farT = originT + slack;

    vec4 lowX = unpackBytes(ray.backwards.x ? node.planes[3] : node.planes[0]);
    vec4 lowY = unpackBytes(ray.backwards.y ? node.planes[4] : node.planes[1]);
    vec4 lowZ = unpackBytes(ray.backwards.z ? node.planes[5] : node.planes[2]);
    vec4 highX = unpackBytes(ray.backwards.x ? node.planes[0] : node.planes[3]);
    vec4 highY = unpackBytes(ray.backwards.y ? node.planes[1] : node.planes[4]);
    vec4 highZ = unpackBytes(ray.backwards.z ? node.planes[2] : node.planes[5]);
    ivec4 enter = max(maxBits(lowX * stepT.x + nearT.x, lowY * stepT.y + nearT.y), maxBits(lowZ * stepT.z + nearT.z, vec4(0.0)));
    ivec4 leave = min(minBits(highX * stepT.x + farT.x, highY * stepT.y + farT.y), minBits(highZ * stepT.z + farT.z, vec4(tMax)));
    uvec4 keys = (uvec4(enter) & ~3u) | uvec4(0u, 1u, 2u, 3u);
    return mix(uvec4(kMissed), keys, lessThanEqual(enter, leave));
}

#endif
