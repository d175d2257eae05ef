// Lambert lobe: sample, eval, pdf. Coupling to the layer above is the caller's.
#include "lib/estimator.glsl"
#include "lib/sampling/warp.glsl"

vec3 sampleDiffuse(vec2 u) {
    return kHemisphere == kHemisphereUniform ? squareToUniformHemisphere(u) : squareToCosineHemisphere(u);
}

vec3 evalDiffuse(vec3 color, vec3 wi) {
    return color * (kInvPi * max(0.0, wi.z));
}

float pdfDiffuse(vec3 wi) {
    return kHemisphere == kHemisphereUniform ? squareToUniformHemispherePdf(wi.z)
                                             : squareToCosineHemispherePdf(wi.z);
}
