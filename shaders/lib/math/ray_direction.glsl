// Directions for the tests of boxes and triangles.
#ifndef LAVALIGHT_RAY_DIRECTION_GLSL
#define LAVALIGHT_RAY_DIRECTION_GLSL

// Smallest component of a direction: keeps quotients finite with coordinates up to kMaxCoordinate. All tests of a ray use
// the same, so changed, direction.
const float kSmallestDirection = 1e-18;

vec3 withoutZeros(vec3 direction) {
    uvec3 sign = floatBitsToUint(direction) & 0x80000000u;
    vec3 smallest = uintBitsToFloat(floatBitsToUint(vec3(kSmallestDirection)) | sign);
    return mix(direction, smallest, lessThan(abs(direction), vec3(kSmallestDirection)));
}

#endif
