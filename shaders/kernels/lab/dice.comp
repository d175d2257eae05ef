#version 460
// The lecture's dice: the mean of 6 * D1 + D2, by both dice or by one at a time.
#include "scene/lab_estimator.glsl"

const uint kDimensionDice = 0u; // 2-D
const uint kDimensionPick = 1u; // 1-D

// A face, 1 to 6: 32 bits times 6, the whole part. Faces differ in probability by less than 2^-29.
float faceOf(uint bits) {
    uint whole;
    uint fraction;
    umulExtended(bits, 6u, whole, fraction);
    return float(whole + 1u);
}

float sampleOnce(SampleKey key) {
    const uvec2 bits = sampleBits2D(key, kDimensionDice);
    if (run.kind == kDiceTogether)
        return 6.0 * faceOf(bits.x) + faceOf(bits.y);
    const float probability = run.a.x;
    if (sample1D(key, kDimensionPick) < probability)
        return 6.0 * faceOf(bits.x) / probability;
    return faceOf(bits.x) / (1.0 - probability);
}
