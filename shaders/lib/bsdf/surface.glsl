// What there is to a surface at a point: the lobes of its BSDF and the layers that they lie in. From the top:
//
//   clearcoat
//   sheen
//   base: metal | dielectric: specular over diffuse | glass
#include "lib/bsdf/clearcoat.glsl"
#include "lib/bsdf/diffuse_transmission.glsl"
#include "lib/bsdf/glass.glsl"
#include "lib/bsdf/multiple_scattering.glsl"
#include "lib/bsdf/sheen.glsl"
#include "lib/bsdf/specular.glsl"
#include "lib/features.glsl"

struct Surface {
    vec3 diffuse; // albedo of the opaque base
    vec3 through; // albedo of its transmission
    Specular specular;
    vec3 multiple; // colour of what metal reflects more than once, weighted
    vec2 coating;     // f0 and f90 (largest channel) of what covers the diffuse base
    float glassShare; // weight of the glass lobe
    Glass glass;
    Clearcoat clearcoat;
    Sheen sheen;
};

bool hasSpecular(Surface s) {
    return sceneHas(kFeatureSpecular) && (s.specular.f90 > 0.0 || s.specular.f0 != vec3(0.0));
}

bool hasMultiple(Surface s) {
    return sceneHas(kFeatureSpecular) && kMultipleScattering != 0u && s.multiple != vec3(0.0);
}

bool hasGlass(Surface s) {
    return sceneHas(kFeatureGlass) && s.glassShare > 0.0;
}

bool hasThrough(Surface s) {
    return sceneHas(kFeatureDiffuseTransmission) && s.through != vec3(0.0);
}

bool hasClearcoat(Surface s) {
    return sceneHas(kFeatureClearcoat) && s.clearcoat.weight > 0.0;
}

bool hasSheen(Surface s) {
    return sceneHas(kFeatureSheen) && s.sheen.color != vec3(0.0);
}

bool isSmoothAlpha(float alpha) {
    return !sceneHas(kFeatureRoughLobes) || (sceneHas(kFeatureSmoothLobes) && alpha < kSmoothAlpha);
}

// Whether the specular and glass lobes are smooth, if there are any.
bool isSmooth(Surface s) {
    return isSmoothAlpha(s.specular.alpha.x);
}

bool isSmoothClearcoat(Surface s) {
    return isSmoothAlpha(s.clearcoat.alpha);
}

// Whether light from behind comes through.
bool isTransmissive(Surface s) {
    return hasGlass(s) || hasThrough(s);
}

// Whether there is anything for light sampling to find.
bool hasNonDelta(Surface s) {
    return s.diffuse != vec3(0.0) || hasThrough(s) || hasSheen(s) || (hasClearcoat(s) && !isSmoothClearcoat(s)) ||
           ((hasSpecular(s) || hasGlass(s)) && !isSmooth(s));
}
