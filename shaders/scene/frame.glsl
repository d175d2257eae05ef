// Frame parameters, the range of the wave, and where a slot belongs in the image.
#include "lib/sampling/sampler.glsl"
#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/wavefront.h"

// The frame is a uniform buffer: in loops, lavapipe reads storage buffers lane by lane, which took 15 % of the fused kernel.
layout(set = 0, binding = BINDING_FRAME, std140) uniform Frame { FrameParameters frame; };
layout(push_constant) uniform Push { WaveRange range; };

uint slotCount() {
    return range.pixelCount * range.sampleCount;
}

uint pixelOfSlot(uint slot) {
    return range.firstPixel + slot / range.sampleCount;
}

SampleKey keyOfSlot(uint slot, uint vertex) {
    return SampleKey(frame.seed, pixelOfSlot(slot), range.firstSample + slot % range.sampleCount, vertex);
}
