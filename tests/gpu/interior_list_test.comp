#version 460
// Applies a row of steps to an empty list of solids, and tells what is on it after each.
#include "lib/interior_list.glsl"

struct Step {
    uint solid;
    uint leaves; // else it is entered
};

struct Answer {
    uint entries[4];
    uint count;
    uint overflow;
    uint contains; // the step's solid
    uint unused;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 20, std430) readonly buffer In { Step steps[]; };
layout(set = 0, binding = 21, std430) writeonly buffer Out { Answer answers[]; };

void main() {
    const uint last = gl_GlobalInvocationID.x;
    if (last >= answers.length())
        return;
    InteriorList list = kNoInterior;
    for (uint i = 0u; i <= last; ++i) {
        if (steps[i].leaves != 0u)
            list = leaveInterior(list, steps[i].solid);
        else
            list = enterInterior(list, steps[i].solid);
    }
    const uint entries[4] =
        uint[4](interiorAt(list, 0u), interiorAt(list, 1u), interiorAt(list, 2u), interiorAt(list, 3u));
    answers[last] = Answer(entries, interiorCount(list), interiorOverflow(list),
                           interiorContains(list, steps[last].solid) ? 1u : 0u, 0u);
}
