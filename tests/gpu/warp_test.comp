#version 460
// The warps of lib/sampling/warp.glsl and their densities, one question per element.
#include "lib/sampling/warp.glsl"

const uint kDisk = 0u;
const uint kCosineHemisphere = 1u;
const uint kTriangle = 2u;
const uint kLinear = 3u; // from questions[i].z to .w

struct Answer {
    vec3 point;          // point of the warp at `u`
    float pdfOfQuestion; // the density at the point `u`, read as the warp's result
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { vec4 questions[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { Answer answers[]; };
layout(push_constant) uniform Push { uint warp; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const vec3 u = questions[i].xyz;
    if (warp == kDisk)
        answers[i] = Answer(vec3(squareToDisk(u.xy), 0.0), squareToDiskPdf());
    else if (warp == kCosineHemisphere)
        answers[i] = Answer(squareToCosineHemisphere(u.xy), squareToCosineHemispherePdf(u.z));
    else if (warp == kLinear)
        answers[i] = Answer(vec3(unitToLinear(u.x, u.z, questions[i].w)), unitToLinearPdf(u.x, u.z, questions[i].w));
    else
        answers[i] = Answer(vec3(squareToTriangle(u.xy), 0.0), squareToTrianglePdfArea(0.5));
}
