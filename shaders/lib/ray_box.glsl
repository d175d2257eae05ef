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
// each rounded by at most 4 half units of its distance from the ray's origin along the main axis, T at most; the ray may
// meet the rounded triangle where it passes the box by as much. So planes move apart by k (|O| + T), which also covers
// the share of |t|: no t beyond T counts. Without it rays leak between neighbouring boxes where triangles share an edge
// in the plane between them.
const float kSlabTolerance = 16.0 / 16777216.0;

// Smallest component of a direction: keeps quotients finite with coordinates up to kMaxCoordinate. All tests of a ray use
// the same, so changed, direction.
const float kSmallestDirection = 1e-18;

struct SlabRay {
    vec3 origin;
    vec3 inverse;    // 1 / direction
    bvec3 backwards; // direction is negative
    bool xMain, yMain; // which component of direction is the largest; z if neither
};

vec3 withoutZeros(vec3 direction) {
    uvec3 sign = floatBitsToUint(direction) & 0x80000000u;
    vec3 smallest = uintBitsToFloat(floatBitsToUint(vec3(kSmallestDirection)) | sign);
    return mix(direction, smallest, lessThan(abs(direction), vec3(kSmallestDirection)));
}

// `direction` comes from withoutZeros.
SlabRay slabRay(vec3 origin, vec3 direction) {
    vec3 size = abs(direction);
    bool xMain = size.x >= size.y && size.x >= size.z;
    return SlabRay(origin, 1.0 / direction, lessThan(direction, vec3(0.0)), xMain, !xMain && size.y >= size.z);
}

vec4 unpackBytes(uint packed) {
    ivec4 bytes = ivec4(packed, packed >> 8u, packed >> 16u, packed >> 24u) & 0xff;
    return vec4(bytes); // from signed integers: unsigned ones convert in several instructions on x86
}

// Where the ray enters the four boxes, at least 0, and where it leaves them, at most tMax: hit where enter <= leave.
void intersectBoxes(SlabRay ray, BvhNode node, float tMax, out vec4 enter, out vec4 leave) {
    uvec3 exponents = uvec3(node.exponents, node.exponents >> 8u, node.exponents >> 16u) & 0xffu;
    vec3 stepT = uintBitsToFloat(exponents << 23u) * ray.inverse;
    vec3 originT = (node.origin - ray.origin) * ray.inverse;
    vec3 reach = abs(originT) + 255.0 * abs(stepT);
    float mainReach = ray.xMain ? reach.x : (ray.yMain ? reach.y : reach.z);
    vec3 slack = kSlabTolerance * (abs(originT) + mainReach);
    vec3 nearT = originT - slack;
    vec3 farT = originT + slack;

    vec4 lowX = unpackBytes(ray.backwards.x ? node.planes[3] : node.planes[0]);
    vec4 lowY = unpackBytes(ray.backwards.y ? node.planes[4] : node.planes[1]);
    vec4 lowZ = unpackBytes(ray.backwards.z ? node.planes[5] : node.planes[2]);
    vec4 highX = unpackBytes(ray.backwards.x ? node.planes[0] : node.planes[3]);
    vec4 highY = unpackBytes(ray.backwards.y ? node.planes[1] : node.planes[4]);
    vec4 highZ = unpackBytes(ray.backwards.z ? node.planes[2] : node.planes[5]);
    enter = max(max(lowX * stepT.x + nearT.x, lowY * stepT.y + nearT.y), max(lowZ * stepT.z + nearT.z, 0.0));
    leave = min(min(highX * stepT.x + farT.x, highY * stepT.y + farT.y), min(highZ * stepT.z + farT.z, tMax));
}

#endif
