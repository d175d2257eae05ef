#version 460
// Glass of any relative index: what samples bring, and eval and pdf towards a direction.
#include "lib/sampling/sampler.glsl"
#include "scene/material.glsl"

struct Question {
    vec3 wo;
    float eta;
    vec3 wi; // direction for eval and pdf
    float alpha;
    uint isThin;
    uint samples; // 0: eval and pdf alone
    uint unused0;
    uint unused1;
};

struct Answer {
    float reflected; // share of the light that samples reflect
    float passed;    // share that passes, as flux
    float largest;   // largest weight of a sample, as flux
    float strayed;   // largest distance of wi from -wo
    float f;         // evalBsdf(wo, wi)
    float pdf;       // pdfBsdf(wo, wi)
    float deltas;    // share of samples of which the pdf is 0
    float wrong;     // samples that are no numbers, and those of which evalBsdf is not weight times pdf
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 20, std430) readonly buffer In { Question questions[]; };
layout(set = 0, binding = 21, std430) writeonly buffer Out { Answer answers[]; };

Surface surfaceOfQuestion(Question q) {
    Surface s = surfaceOf(fetchMaterial(0u), true);
    s.specular.alpha = vec2(q.alpha);
    s.glass = makeGlass(vec3(1.0), vec2(q.alpha), q.eta, q.isThin != 0u, s.glass.film);
    return s;
}

bool isNumber(float x) {
    return !isnan(x) && !isinf(x);
}

void addSample(Surface s, Question q, BsdfSample drawn, inout Answer a) {
    const float flux = drawn.weight.x * drawn.eta * drawn.eta;
    a.reflected += drawn.wi.z > 0.0 ? flux : 0.0;
    a.passed += drawn.wi.z < 0.0 ? flux : 0.0;
    a.largest = max(a.largest, flux);
    a.strayed = max(a.strayed, flux > 0.0 ? distance(drawn.wi, -q.wo) : 0.0);
    a.deltas += drawn.pdf == 0.0 ? 1.0 : 0.0;
    const float product = drawn.weight.x * drawn.pdf;
    const bool isEval = drawn.pdf == 0.0 || abs(product - evalBsdf(s, q.wo, drawn.wi).x) <= 1e-4 * product;
    a.wrong += !isNumber(flux) || !isNumber(drawn.pdf) || flux < 0.0 || !isEval ? 1.0 : 0.0;
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const Question q = questions[i];
    const Surface s = surfaceOfQuestion(q);
    Answer a = Answer(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (uint k = 0u; k < q.samples; ++k) {
        const SampleKey key = SampleKey(5u, i, k, 1u);
        addSample(s, q, sampleBsdf(s, q.wo, sample2D(key, kDimensionBsdf), sample1D(key, kDimensionLobe)), a);
    }
    const float n = max(float(q.samples), 1.0);
    a.reflected /= n;
    a.passed /= n;
    a.deltas /= n;
    a.f = evalBsdf(s, q.wo, q.wi).x;
    a.pdf = pdfBsdf(s, q.wo, q.wi);
    answers[i] = a;
}
