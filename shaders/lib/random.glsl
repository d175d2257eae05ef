// Random numbers as pure functions of their key.
// Based on: Jarzynski, Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020 (pcg4d).

// Named dimensions of a vertex. New ones go to the end: the numbers are part of what a seed means.
const uint kDimensionPixel = 0u;        // position within the pixel (camera vertex)
const uint kDimensionLight = 1u;        // xy: point on the light; z: which light
const uint kDimensionBsdf = 2u;         // xy: direction; z: which lobe
const uint kDimensionRoulette = 3u;

struct SampleKey {
    uint seed;
    uint pixel;  // row-major index in the image
    uint index;  // sample number of that pixel
    uint vertex; // 0 at the camera
};

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
vec3 bitsToUnit(uvec3 bits) {
    return vec3(bits >> 8u) * 5.9604644775390625e-8; // 2^-24
}

// Four independent uniform words for one named dimension of one vertex.
uvec4 sampleBits(SampleKey key, uint dimension) {
    return pcg4d(uvec4(key.pixel, key.index, key.vertex << 8u | dimension, key.seed));
}

// Three independent uniform numbers in [0, 1).
vec3 sample3D(SampleKey key, uint dimension) {
    return bitsToUnit(sampleBits(key, dimension).xyz);
}
