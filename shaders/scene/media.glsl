// What fills the places that a path runs through: the medium of the solid around it, or nothing.
// Based on: KHR_materials_volume ("Attenuation"); Schmidt and Budge, "Simple Nested Dielectrics in Ray Traced Images", 2002,
// with the smallest body in the place of their priorities.
#include "lib/features.glsl"
#include "lib/interior_list.glsl"
#include "shared/bindings.h"
#include "shared/scene.h"
#include "shared/wavefront.h"

layout(set = 0, binding = BINDING_SOLIDS) uniform utextureBuffer solids; // kSolidTexels each

SolidRecord fetchSolid(uint index) {
    const int texel = int(index * kSolidTexels);
    const vec4 a = uintBitsToFloat(texelFetch(solids, texel));
    const vec4 b = uintBitsToFloat(texelFetch(solids, texel + 1));
    return SolidRecord(a.xyz, a.w, b.x, float[3](0.0, 0.0, 0.0));
}

SolidRecord mediumOf(InteriorList list) {
    return fetchSolid(solidAround(list));
}

// Beer-Lambert, over `distance` metres.
vec3 transmittance(SolidRecord medium, float distance) {
    return exp(-medium.attenuation * distance);
}
