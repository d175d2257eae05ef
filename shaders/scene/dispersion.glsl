// Glass that refracts colours differently: where a path meets it, one of its colours is chosen and goes on alone.
// Based on: KHR_materials_dispersion. Each channel of the result has the mean that it has with its own index throughout.
#include "scene/material.glsl"
#include "shared/wavefront.h"

bool isDispersive(MaterialRecord material) {
    return material.dispersion > 0.0 && material.transmission > 0.0 && (material.flags & kMaterialSolid) != 0u &&
           material.ior > 0.0;
}

const uint kMiddleChannel = 1u;

// The index in red, green or blue: Cauchy's curve between Fraunhofer's lines C, d and F as a straight one; dispersion = 20 /
// Abbe number. 0, an infinite index, stays.
float channelIor(float ior, float dispersion, uint channel) {
    const float halfSpread = (ior - 1.0) * 0.025 * dispersion;
    return dispersion > 0.0 && ior > 0.0 ? max(ior + (float(channel) - 1.0) * halfSpread, 1.0) : ior;
}

// Chooses by what the channels carry, so that the largest weight of a path does not grow; one that is alone stays as it is.
uint chooseChannel(float u, inout Path path) {
    const vec3 t = path.throughput;
    const float sum = t.x + t.y + t.z;
    const float place = u * sum;
    const bool isRed = place < t.x || t.yz == vec2(0.0);
    const bool isBlue = !isRed && (place >= t.x + t.y || t.y == 0.0) && t.z > 0.0;
    path.throughput = isRed ? vec3(sum, 0.0, 0.0) : isBlue ? vec3(0.0, 0.0, sum) : vec3(0.0, sum, 0.0);
    return isRed ? 0u : isBlue ? 2u : kMiddleChannel;
}
