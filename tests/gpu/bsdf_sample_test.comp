#version 460
// Samples of the whole BSDF of a material, with what eval and pdf say about the same directions.
#include "lib/sampling/sampler.glsl"
#include "scene/material.glsl"

struct Answer {
    vec3 wi;
    float pdf;      // as sampleBsdf returns it
    vec3 weight;
    float pdfAgain; // pdfBsdf of the direction
    vec3 f;         // evalBsdf of the direction
    float unused;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 21, std430) writeonly buffer Out { Answer answers[]; };
layout(push_constant) uniform Push {
    vec3 wo;
    uint material;
};

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const MaterialRecord record = fetchMaterial(material);
    Surface s = surfaceOf(record, true);
    s.clearcoat.normal = normalize(vec3(record.clearcoatNormalScale, 0.0, 1.0));
    const SampleKey key = SampleKey(3u, i, material, 1u);
    const BsdfSample drawn = sampleBsdf(s, wo, sample2D(key, kDimensionBsdf), sample1D(key, kDimensionLobe));
    answers[i] =
        Answer(drawn.wi, drawn.pdf, drawn.weight, pdfBsdf(s, wo, drawn.wi), evalBsdf(s, wo, drawn.wi), 0.0);
}
