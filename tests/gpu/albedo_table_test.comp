#version 460
// The tabulated albedo of the GGX lobe beside a brute-force integral of the lobe that shading evaluates: kStrata answers to
// a question, each a row of strata, since lavapipe ends all loops of an invocation after 65,535 turns without a word.
#include "lib/bsdf_specular.glsl"
#include "scene/albedo_table.glsl"

const uint kStrata = 512u; // per axis: directions lost below the horizon make the integrand jump

struct Question {
    float cosTheta;
    float alpha;
};

struct Answer {
    vec2 table;
    vec2 rowMean;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 20, std430) readonly buffer In { Question questions[]; };
layout(set = 0, binding = 21, std430) writeonly buffer Out { Answer answers[]; };

// f |cos| / pdf of one sample, for F0 and for F90 alone.
vec2 sampleTerms(vec2 u, vec3 wo, float alpha) {
    const vec3 wi = sampleSpecular(u, wo, vec2(alpha));
    if (wi.z <= 0.0)
        return vec2(0.0);
    const Film noFilm = Film(0.0, 1.0, 0.0);
    const vec2 f = vec2(evalSpecular(Specular(vec3(1.0), 0.0, vec2(alpha), noFilm), wo, wi).x,
                        evalSpecular(Specular(vec3(0.0), 1.0, vec2(alpha), noFilm), wo, wi).x);
    return f / pdfSpecular(vec2(alpha), wo, wi);
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const Question q = questions[i / kStrata];
    const vec3 wo = vec3(sqrt(1.0 - q.cosTheta * q.cosTheta), 0.0, q.cosTheta);
    vec2 sum = vec2(0.0);
    for (uint x = 0u; x < kStrata; ++x)
        sum += sampleTerms((vec2(x, i % kStrata) + 0.5) / float(kStrata), wo, q.alpha);
    answers[i] = Answer(specularAlbedoTerms(q.cosTheta, q.alpha), sum / float(kStrata));
}
