#version 460
// A one-dimensional integral by strata: one of them picked at random, all of them, or infinitely many.
#include "scene/lab_estimator.glsl"

layout(set = 0, binding = BINDING_LAB_TABLE, std430) readonly buffer LabTable { float pmf[]; };

const uint kDimensionPoint = 0u; // 1-D; a vertex of its own for each stratum
const uint kDimensionPick = 1u;  // 1-D

float integrand(float x) {
    return exp(kStrataRate * x);
}

uint pickStratum(float u) {
    uint i = 0u;
    for (float upTo = pmf[0]; i + 1u < run.count && u >= upTo; upTo += pmf[i])
        ++i;
    return i;
}

// A stratum i, then a point in it: density pmf[i] * count.
float samplePicked(SampleKey key) {
    const uint i = pickStratum(sample1D(key, kDimensionPick));
    const float width = 1.0 / float(run.count);
    const float x = (float(i) + sample1D(key, kDimensionPoint)) * width;
    return integrand(x) * width / pmf[i];
}

float sampleEach(SampleKey key) {
    const float width = 1.0 / float(run.count);
    float sum = 0.0;
    for (uint i = 0u; i < run.count; ++i) {
        key.vertex = i;
        sum += integrand((float(i) + sample1D(key, kDimensionPoint)) * width);
    }
    return sum * width;
}

// x = P^-1(u) of the cumulative P(x) = (exp(rate x) - 1) / (exp(rate) - 1), whose density is the integrand over its
// integral: every sample is the integral.
float sampleByPdf(SampleKey key) {
    const float span = exp(kStrataRate) - 1.0;
    const float x = log(1.0 + span * sample1D(key, kDimensionPoint)) / kStrataRate;
    const float pdf = kStrataRate * exp(kStrataRate * x) / span;
    return integrand(x) / pdf;
}

float sampleOnce(SampleKey key) {
    if (run.kind == kStrataPicked)
        return samplePicked(key);
    return run.kind == kStrataEach ? sampleEach(key) : sampleByPdf(key);
}
