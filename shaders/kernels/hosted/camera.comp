#version 460
// Starts the paths of a wave: a record for each slot.
#include "scene/path_layers.glsl"
#include "scene/path_rays.glsl"
#include "scene/records.glsl"

layout(local_size_x = 64) in;

void main() {
    if (!hasRecord())
        return;
    const uint slot = recordAtHand();
    const Ray ray = cameraRayOf(slot);
    writePlane(kPlaneOrigin, slot, ray.origin, slot | kRecordGoesOn);
    writeNext(slot, ray, kNewPath);
    startLayers(slot);
}
