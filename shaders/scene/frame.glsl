// Frame parameters, the range of the wave, and where a slot belongs in the image.
#include "lib/features.glsl"
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

// Pixel of the image, row by row from the top. The film may hold a part of the image alone.
uint pixelOfSlot(uint slot) {
    const uint pixel = range.firstPixel + slot / range.sampleCount;
    if (!sceneHas(kFeatureCrop))
        return pixel;
    return frame.cropStart + pixel / frame.cropWidth * frame.imageWidth + pixel % frame.cropWidth;
}

SampleKey keyOfSlot(uint slot, uint vertex) {
    return SampleKey(frame.seed, pixelOfSlot(slot), range.firstSample + slot % range.sampleCount, vertex);
}
