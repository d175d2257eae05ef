// The point that the light tree picks lights for, and how a ray that starts there remembers it: MIS asks again, at the other
// end, how likely light sampling was to find what the ray found.
#ifndef LAVALIGHT_RECEIVER_GLSL
#define LAVALIGHT_RECEIVER_GLSL

#include "lib/math/octahedral.glsl"

struct Receiver {
    vec3 p;
    vec3 n;         // shading normal on the side of wo, as packed
    bool bothSides; // light from behind counts too
};

//   packed:  | octahedral normal, 2 x 16 bits, the lowest of them replaced by | bothSides |
uint packReceiver(vec3 n, bool bothSides) {
    return (encodeOctahedral(n) & ~1u) | (bothSides ? 1u : 0u);
}

Receiver unpackReceiver(vec3 p, uint packed) {
    return Receiver(p, decodeOctahedral(packed), (packed & 1u) != 0u);
}

#endif
