// Glass that refracts colours differently: where a path meets it, one of its colours is chosen and goes on alone.
// Based on: KHR_materials_dispersion. Each channel of the result has the mean that it has with its own index throughout.
#include "scene/material.glsl"
#include "shared/wavefront.h"

bool isDispersive(MaterialRecord material) {
    return material.dispersion > 0.0 && material.transmission > 0.0 && (material.flags & kMaterialSolid) != 0u &&
           material.ior > 0.0;
}

// Indices of red, green, blue: Cauchy's curve between Fraunhofer's lines C, d and F as a straight one; dispersion = 20 / Abbe
// number.
vec3 channelIors(float ior, float dispersion) {
    const float halfSpread = (ior - 1.0) * 0.025 * dispersion;
    return max(vec3(ior - halfSpread, ior, ior + halfSpread), 1.0);
}

// Chooses by what the channels carry, so that the largest weight of a path does not grow; one that is alone stays as it is.
void chooseChannel(float u, inout Path path, inout MaterialRecord material) {
    const vec3 iors = channelIors(material.ior, material.dispersion);
    const vec3 t = path.throughput;
    const float sum = t.x + t.y + t.z;
    const float place = u * sum;
    const bool isRed = place < t.x || t.yz == vec2(0.0);
    const bool isBlue = !isRed && (place >= t.x + t.y || t.y == 0.0) && t.z > 0.0;
    path.throughput = isRed ? vec3(sum, 0.0, 0.0) : isBlue ? vec3(0.0, 0.0, sum) : vec3(0.0, sum, 0.0);
    material.ior = isRed ? iors.x : isBlue ? iors.z : iors.y;
}
