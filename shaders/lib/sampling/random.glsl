// Random words by hashing, and words as numbers.
// Based on: Jarzynski, Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020 (pcg4d).

uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// 24 bits of `bits` as a number in [0, 1): every value is exact and 1 is never reached.
float bitsToUnit(uint bits) {
    return float(bits >> 8u) * 5.9604644775390625e-8; // 2^-24
}

vec2 bitsToUnit(uvec2 bits) {
    return vec2(bits >> 8u) * 5.9604644775390625e-8;
}
