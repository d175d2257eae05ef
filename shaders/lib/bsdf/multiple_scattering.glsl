// What rough metal sends on after several reflections between its facets: eval and albedo; drawn as the diffuse lobe is.
// Based on: Kulla, Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course notes; Kelemen,
// Szirmay-Kalos 2001. glTF's appendix B has no such lobe: --multiple-scattering on.
#include "lib/math/constants.glsl"

// Share of what a first reflection lost that all further ones return. f0: of the metal, whose Fresnel reflectance is
// Schlick's; loss: 1 - albedo of a lobe that loses nothing but by masking, averaged by the cosine.
vec3 multipleScatteringColor(vec3 f0, float loss) {
    const vec3 average = (20.0 * f0 + 1.0) / 21.0;
    return average * average * (1.0 - loss) / (1.0 - average * loss);
}

// f |cos| from the losses towards wo and wi and on average. Over wi it integrates to color * lossO.
vec3 evalMultipleScattering(vec3 color, vec3 wi, float lossO, float lossI, float loss) {
    return color * (lossO * lossI / max(loss, 1e-6) * kInvPi * wi.z);
}
