// Lambert lobe to the other side, as of paper and leaves: sample, eval, pdf. Reflection mirrored through the surface.
// Based on: KHR_materials_diffuse_transmission.
#include "lib/bsdf/diffuse.glsl"

vec3 sampleDiffuseTransmission(vec2 u) {
    return -sampleDiffuse(u);
}

vec3 evalDiffuseTransmission(vec3 color, vec3 wi) {
    return evalDiffuse(color, -wi);
}

float pdfDiffuseTransmission(vec3 wi) {
    return pdfDiffuse(-wi);
}
