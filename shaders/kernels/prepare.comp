#version 460
// Turns the queue lengths that shade left into the sizes of the dispatches that follow.
#include "scene/frame.glsl"
#include "scene/wave.glsl"

layout(local_size_x = 1) in;
// Sizes of dispatches: element 0 is for connect, element 1 for extend and shade of the next bounce.
layout(set = 0, binding = BINDING_DISPATCH_SIZES, std430) writeonly buffer DispatchSizes { DispatchSize sizes[]; };

DispatchSize sizeFor(uint items) {
    return DispatchSize((items + kWorkgroupSize - 1u) / kWorkgroupSize, 1u, 1u, 0u);
}

void main() {
    sizes[0] = sizeFor(counters[range.bounce].shadowRays);
    sizes[1] = sizeFor(counters[range.bounce + 1u].rays);
}
