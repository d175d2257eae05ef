#version 460
// Maps colours by every curve.
#include "lib/film/tone_map.glsl"

struct Question {
    vec3 color;
    uint curve;
};

struct Answer {
    vec3 display;
    float unused0;
    vec3 signal;
    float unused1;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { Question questions[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { Answer answers[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const vec3 display = toneMap(questions[i].curve, questions[i].color);
    answers[i] = Answer(display, 0.0, encodeSrgb(display), 0.0);
}
