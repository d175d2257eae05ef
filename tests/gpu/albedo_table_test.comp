#version 460
// The tabulated albedos of the GGX lobe and of sheen beside brute-force integrals of the lobes that shading evaluates: kStrata
// answers to a question, each a row of strata, since lavapipe ends all loops of an invocation after 65,535 turns without a word.
#include "lib/bsdf/sheen.glsl"
#include "lib/bsdf/specular.glsl"
#include "scene/albedo_table.glsl"

const uint kStrata = 512u; // per axis: directions lost below the horizon make the integrand jump

struct Question {
    float cosTheta;
    float alpha;
};

struct Answer {
    vec4 table; // F0, F90, sheen
    vec4 rowMean;
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

float sampleSheenOnce(vec2 u, vec3 wo, float alpha) {
    const vec3 wi = sampleSheen(u);
    return evalCharlie(alpha, wo, wi) / pdfSheen(wi);
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const Question q = questions[i / kStrata];
    const vec3 wo = vec3(sqrt(1.0 - q.cosTheta * q.cosTheta), 0.0, q.cosTheta);
    vec3 sum = vec3(0.0);
    for (uint x = 0u; x < kStrata; ++x) {
        const vec2 u = (vec2(x, i % kStrata) + 0.5) / float(kStrata);
        sum += vec3(sampleTerms(u, wo, q.alpha), sampleSheenOnce(u, wo, q.alpha));
    }
    const vec3 table = vec3(specularAlbedoTerms(q.cosTheta, q.alpha), charlieAlbedo(q.cosTheta, q.alpha));
    answers[i] = Answer(vec4(table, 0.0), vec4(sum / float(kStrata), 0.0));
}
