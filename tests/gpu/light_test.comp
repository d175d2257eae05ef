#version 460
// Picks emitters and samples them as next-event estimation does.
#include "lib/ray_offset.glsl"
#include "scene/light.glsl"

struct Answer {
    vec3 wi;
    float pdf;
    vec3 emission;
    uint emitter;
    float pmf;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 21, std430) writeonly buffer Out { Answer answers[]; };
layout(push_constant) uniform Push {
    vec3 from;
    uint emitterCount;
};

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const uvec4 bits = sampleBits(SampleKey(5u, i, 0u, 1u), kDimensionLight);
    const uint emitter = pickEmitter(bits.z, emitterCount);
    const LightSample light = sampleLight(from, bits, emitterCount);
    answers[i] = Answer(light.wi, light.pdf, light.emission, emitter, emitterPmf(emitter));
}
