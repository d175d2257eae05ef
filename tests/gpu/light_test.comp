#version 460
// Picks lights and samples them as next-event estimation does.
#include "lib/sampling/sampler.glsl"
#include "scene/light.glsl"

struct Answer {
    vec3 wi;
    float pdf;
    vec3 radiance;
    uint light;
    float pmf;          // pmf of the pick
    float evaluatedPmf; // by what MIS asks
    float place;
    float isDelta;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 21, std430) writeonly buffer Out { Answer answers[]; };
layout(set = 0, binding = BINDING_FRAME, std140) uniform Frame { FrameParameters frame; };
layout(push_constant) uniform Push { uint bothSides; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const SampleKey key = SampleKey(5u, i, 0u, 1u);
    const uvec2 bits = sampleBits2D(key, kDimensionLight);
    const Receiver receiver = Receiver(frame.cameraPosition, frame.cameraUp, bothSides != 0u);
    const LightPick pick = pickLight(frame, receiver, bits.x);
    const LightSample drawn = sampleLight(frame, receiver, receiver.n, bits);
    answers[i] = Answer(drawn.wi, drawn.pdf, drawn.radiance, pick.light, pick.pmf, lightPmf(frame, receiver, pick.light),
                        pick.place, drawn.isDelta ? 1.0 : 0.0);
}
