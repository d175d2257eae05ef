#version 460
// Adds runs of floats to exact sums of three and of four words and to one with sign, and reads two of them.
#include "lib/film/fixed_point.glsl"
#include "shared/film.h"

const uint kRun = 16u;

struct Answer {
    uvec4 four;
    uvec3 three;
    uint leftThree; // how many additions left the range of three words
    uint leftFour;
    float value; // what the sum of three words stands for
    float signedValue;
    uint leftSigned; // how many values were limited
    uvec4 signedFour;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { float values[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { Answer answers[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    Answer answer = Answer(uvec4(0u), uvec3(0u), 0u, 0u, 0.0, 0.0, 0u, uvec4(0u));
    for (uint k = 0u; k < kRun; ++k) {
        const float x = values[i * kRun + k];
        answer.leftSigned += addSigned(answer.signedFour, x, kSumLowestExponent) ? 0u : 1u;
        if (x < 0.0)
            continue; // the others are without sign
        answer.leftThree += addExactly(answer.three, x, kSumLowestExponent) ? 0u : 1u;
        answer.leftFour += addExactly(answer.four, x, kSquareLowestExponent) ? 0u : 1u;
    }
    answer.value = fromFixed(answer.three, kSumLowestExponent);
    answer.signedValue = fromSigned(answer.signedFour, kSumLowestExponent);
    answers[i] = answer;
}
