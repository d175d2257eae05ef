#version 460
// Looks textures up.
#include "scene/texture.glsl"

struct Question {
    vec2 uv; // transformed
    uint texture;
    uint unused;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer In { Question questions[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Out { vec4 values[]; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i < values.length())
        values[i] = filteredTexture(fetchTexture(questions[i].texture), questions[i].uv);
}
