// What every lab kernel shares: main() takes the samples of one invocation and stores their moments. The kernel gives
// the estimator, as sampleOnce.
#include "lib/math/running_moments.glsl"
#include "lib/sampling/sampler.glsl"
#include "shared/lab.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = BINDING_LAB_OUT, std430) writeonly buffer LabOut { LabMoments labOut[]; };
layout(push_constant) uniform Push { LabRun run; };

// One sample of the estimator: a number whose mean is sought.
float sampleOnce(SampleKey key);

void main() {
    const uint invocation = run.first + gl_GlobalInvocationID.x;
    if (invocation > (run.sampleCount - 1u) / run.samplesEach) // all groups are full, but the last one may have less work
        return;
    const uint count = min(run.samplesEach, run.sampleCount - invocation * run.samplesEach);
    SampleKey key = SampleKey(run.seed, invocation / run.blocks, (invocation % run.blocks) * run.samplesEach, 0u);
    LabMoments moments = noMoments();
    for (uint i = 0u; i < count; ++i) {
        addSample(moments, sampleOnce(key));
        key.index += 1u;
    }
    labOut[invocation] = moments;
}
