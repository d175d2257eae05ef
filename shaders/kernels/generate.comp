#version 460
// Starts the paths of a wave: camera rays through random points of their pixels.
#include "lib/camera.glsl"
#include "scene/frame.glsl"
#include "scene/wave.glsl"

layout(local_size_x = 64) in;

void main() {
    const uint slot = gl_GlobalInvocationID.x;
    if (slot >= range.pixelCount * range.sampleCount)
        return;
    const uint pixel = pixelOfSlot(slot);
    const vec2 corner = vec2(pixel % frame.imageWidth, pixel / frame.imageWidth);
    const vec2 jitter = sample2D(keyOfSlot(slot, 0u), kDimensionPixel);
    rays[slot] = cameraRay(frame, corner + jitter);
    paths[slot] = Path(vec3(1.0), 0.0, vec3(0.0), 1.0);
    queues[rayQueueStart(0u, frame.waveSize) + slot] = slot;
    if (slot == 0u)
        counters[0].rays = range.pixelCount * range.sampleCount;
}
