#version 460
// Visible normals: sampled, or their density at given ones.
#include "lib/bsdf/microfacet.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { vec4 questions[]; }; // a point of the square, or a normal
layout(set = 0, binding = 1, std430) writeonly buffer Out { vec4 answers[]; }; // the normal there, or its density in x
layout(push_constant) uniform Push {
    vec3 wo;
    uint wantsPdf;
    vec2 alpha;
};

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    if (wantsPdf != 0u)
        answers[i] = vec4(squareToVisibleNormalPdf(questions[i].xyz, wo, alpha));
    else
        answers[i] = vec4(squareToVisibleNormal(questions[i].xy, wo, alpha), 0.0);
}
