#version 460
// Starts the paths of a wave.
#include "scene/path_layers.glsl"
#include "scene/path_rays.glsl"
#include "scene/wave.glsl"

layout(local_size_x = 64) in;

void main() {
    const uint slot = gl_GlobalInvocationID.x;
    if (slot >= slotCount())
        return;
    rays[slot] = cameraRayOf(slot);
    paths[slot] = kNewPath;
    startLayers(slot);
    queues[rayQueueStart(0u, frame.waveSize) + slot] = slot;
    if (slot == 0u)
        counters[0].rays = slotCount();
}
