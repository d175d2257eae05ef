#version 460
// The whole BSDF of a material: eval, pdf and the swapped eval for pairs of directions.
#include "scene/material.glsl"

struct Question {
    vec3 wo;
    uint material;
    vec3 wi;
    float unused;
};

struct Answer {
    vec3 f;        // evalBsdf(wo, wi)
    float pdf;     // pdfBsdf(wo, wi)
    vec3 swapped;  // evalBsdf(wi, wo), both mirrored to the other side if wi lies there
    float unused;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 20, std430) readonly buffer In { Question questions[]; };
layout(set = 0, binding = 21, std430) writeonly buffer Out { Answer answers[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const Question q = questions[i];
    const MaterialRecord record = fetchMaterial(q.material);
    Surface s = surfaceOf(record, true);
    s.clearcoat.normal = normalize(vec3(record.clearcoatNormalScale, 0.0, 1.0));
    const vec3 side = vec3(1.0, 1.0, sign(q.wi.z));
    const vec3 swapped = evalBsdf(s, q.wi * side, q.wo * side);
    answers[i] = Answer(evalBsdf(s, q.wo, q.wi), pdfBsdf(s, q.wo, q.wi), swapped, 0.0);
}
