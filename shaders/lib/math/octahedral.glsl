// Unit vectors in 32 bits: octahedral map, two 16-bit signed normalised numbers.
// Based on: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), 2014.
#ifndef LAVALIGHT_OCTAHEDRAL_GLSL
#define LAVALIGHT_OCTAHEDRAL_GLSL

vec3 decodeOctahedral(uint bits) {
    const vec2 e = unpackSnorm2x16(bits);
    vec3 v = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    const float fold = max(-v.z, 0.0);
    v.xy -= fold * vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
    return normalize(v);
}

uint encodeOctahedral(vec3 v) {
    const vec3 p = v / (abs(v.x) + abs(v.y) + abs(v.z));
    const vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return packSnorm2x16(p.z >= 0.0 ? p.xy : folded);
}

#endif
