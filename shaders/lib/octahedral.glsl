// Unit vectors in 32 bits: octahedral map, two 16-bit signed normalised numbers.
// Based on: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 3(2), 2014.

vec3 decodeOctahedral(uint bits) {
    const vec2 e = unpackSnorm2x16(bits);
    vec3 v = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    const float fold = max(-v.z, 0.0);
    v.xy -= fold * vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
    return normalize(v);
}
