#version 460
// Directional albedo of a material by Monte Carlo: sums over batches of BSDF samples.
#include "lib/sampling/sampler.glsl"
#include "scene/material.glsl"

const uint kBatch = 256u;

layout(local_size_x = 64) in;
layout(set = 0, binding = 21, std430) writeonly buffer Out { vec4 means[]; }; // means of one batch each
layout(push_constant) uniform Push {
    vec3 wo;
    uint material;
};

void main() {
    const uint batch = gl_GlobalInvocationID.x;
    if (batch >= means.length())
        return;
    const MaterialRecord record = fetchMaterial(material);
    Surface s = surfaceOf(record, true);
    s.clearcoat.normal = normalize(vec3(record.clearcoatNormalScale, 0.0, 1.0));
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < kBatch; ++i) {
        const SampleKey key = SampleKey(4u, batch, i, material);
        const BsdfSample drawn = sampleBsdf(s, wo, sample2D(key, kDimensionBsdf), sample1D(key, kDimensionLobe));
        sum += drawn.weight * (drawn.eta * drawn.eta); // flux, where the weight is of radiance
    }
    means[batch] = vec4(sum / float(kBatch), 0.0);
}
