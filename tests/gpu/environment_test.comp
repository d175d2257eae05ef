#version 460
// Draws directions of an environment map, and asks for radiance and density of given ones.
#include "scene/environment.glsl"

struct Answer {
    vec3 wi;
    float pdf; // as sampled
    vec3 radiance;
    float evaluatedPdf; // by what MIS asks
    vec2 uv;            // point of the question's direction
    vec2 unused;
    vec3 again; // direction of that uv
    float unusedToo;
};

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_FRAME, std140) uniform Frame { FrameParameters frame; };
layout(set = 0, binding = 40, std430) readonly buffer In { vec4 questions[]; };
layout(set = 0, binding = 41, std430) writeonly buffer Out { Answer answers[]; };
layout(push_constant) uniform Push { uint isSampling; };

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    LightSample drawn = kNoLightSample;
    drawn.wi = questions[i].xyz;
    if (isSampling != 0u)
        drawn = sampleEnvironment(frame, vec3(0.0), vec3(0.0, 0.0, 1.0), questions[i].xy, 1.0);
    const vec2 uv = directionToEquirectangular(drawn.wi);
    answers[i] = Answer(drawn.wi, drawn.pdf, environmentRadiance(frame, drawn.wi), environmentPdf(frame, drawn.wi, 0.0),
                        uv, vec2(0.0), equirectangularToDirection(uv), 0.0);
}
