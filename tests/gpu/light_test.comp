#version 460
// Picks lights and samples them as next-event estimation does.
#include "lib/sampler.glsl"
#include "scene/light.glsl"

struct Answer {
    vec3 wi;
    float pdf;
    vec3 radiance;
    uint light;
    float pmf;
    float isDelta;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 21, std430) writeonly buffer Out { Answer answers[]; };
layout(push_constant) uniform Push {
    FrameParameters frame;
};

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const SampleKey key = SampleKey(5u, i, 0u, 1u);
    const uvec2 bits = sampleBits2D(key, kDimensionLight);
    const uint light = pickLight(bits.x, frame.lightCount).light;
    const LightSample drawn = sampleLight(frame, Receiver(frame.cameraPosition, vec3(0, 0, 1)), bits);
    answers[i] = Answer(drawn.wi, drawn.pdf, drawn.radiance, light, lightPmf(light), drawn.isDelta ? 1.0 : 0.0);
}
