#version 460
// The reflectance of thin films, and of what they lie on.
#include "lib/bsdf/thin_film.glsl"

struct Question {
    vec3 f0; // F0 of the base
    float cosTheta;
    float ior;
    float thickness;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 20, std430) readonly buffer In { Question questions[]; };
layout(set = 0, binding = 21, std430) writeonly buffer Out { vec4 answers[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const Question q = questions[i];
    answers[i] = vec4(filmReflectance(Film(1.0, q.ior, q.thickness), q.f0, q.cosTheta), 0.0);
}
