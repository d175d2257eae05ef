// How the layers of a surface dim each other, and what share of the light each lobe returns. All of it goes by directional
// albedo, so that no layer hands down what it reflects, and is reciprocal.
#include "lib/bsdf/surface.glsl"

// x, y: directional albedo of the GGX lobe is f0 * x + f90 * y at this cosine. From scene/albedo_table.glsl.
vec2 specularAlbedoTerms(float cosTheta, float alpha);
// What the lobe loses between its facets if these reflect everything: 1 - x - y.
float specularMaskingLoss(float cosTheta, float alpha);
// Terms and loss averaged over the hemisphere by the cosine.
vec2 specularAlbedoAverage(float alpha);
float specularMaskingLossAverage(float alpha);
// Directional albedo of white sheen, which may exceed 1.
float charlieAlbedo(float cosTheta, float alpha);

float meanOf(vec3 v) {
    return (v.x + v.y + v.z) * (1.0 / 3.0);
}

float largestOf(vec3 v) {
    return max(v.x, max(v.y, v.z));
}

// A roughness whose albedo that of an anisotropic coating does not exceed, by the energy test: the one in the azimuth of w
// (along the normal the geometric mean), and less the more they differ.
float alphaTowards(Surface s, vec3 w) {
    if (!sceneHas(kFeatureAnisotropy))
        return s.specular.alpha.y;
    const vec2 stretched = s.specular.alpha * w.xy;
    const float none = 1e-6; // sine^2 below which there is no azimuth
    const vec2 alpha = s.specular.alpha;
    const float along2 = (dot(stretched, stretched) + none * alpha.x * alpha.y) / (dot(w.xy, w.xy) + none);
    return sqrt(along2 * sqrt(alpha.y / max(alpha.x, 1e-20)));
}

// 1 - E of the coating; the curve that bounds a film may exceed 1 at grazing angles.
float uncovered(Surface s, vec3 w) {
    return max(0.0, 1.0 - dot(s.coating, specularAlbedoTerms(w.z, alphaTowards(s, w))));
}

// What a single reflection from white facets loses, for the metal's multiple scattering.
float maskingLoss(Surface s, vec3 w) {
    return specularMaskingLoss(w.z, alphaTowards(s, w));
}

// What the lobe loses on average, at least: an anisotropic one loses more than one of its smaller alpha.
float averageMaskingLoss(vec2 alpha) {
    return specularMaskingLossAverage(alpha.x);
}

// Share of light that the dielectric coating lets through to the diffuse base, (1 - E(wo)) (1 - E(wi)) / (1 - Eavg): the
// base then reflects exactly (1 - E(wo)) * diffuse, or less under an anisotropic coating, whose average is that of its larger
// alpha at least. Kelemen, Szirmay-Kalos 2001.
float coupling(Surface s, vec3 wo, vec3 wi) {
    if (!sceneHas(kFeatureSpecular) || s.coating.y <= 0.0)
        return 1.0;
    const float average = dot(vec2(s.coating.x, min(s.coating.y, 1.0)), specularAlbedoAverage(s.specular.alpha.x));
    return uncovered(s, wo) * uncovered(s, vec3(wi.xy, abs(wi.z))) / max(1.0 - average, 1e-4);
}

float clearcoatAlbedo(Clearcoat c, vec3 w) {
    const float cosTheta = max(0.0, dot(c.normal, w));
    return c.weight * dot(vec2(kClearcoatF0, 1.0), specularAlbedoTerms(cosTheta, c.alpha));
}

// What is left to layers below a clearcoat: 1 - E, by the direction that leaves less. With a base that is not only diffuse,
// the coupling above would gain energy; KHR_materials_clearcoat's 1 - F(wo) is not reciprocal.
float throughClearcoat(Surface s, vec3 wo, vec3 wi) {
    if (!hasClearcoat(s))
        return 1.0;
    const vec3 above = vec3(wi.xy, abs(wi.z));
    return 1.0 - max(clearcoatAlbedo(s.clearcoat, wo), clearcoatAlbedo(s.clearcoat, above));
}

// What is left to layers below sheen, as in KHR_materials_sheen.
float throughSheen(Surface s, float cosO, float cosI) {
    if (!hasSheen(s))
        return 1.0;
    const float e = max(charlieAlbedo(cosO, s.sheen.alpha), charlieAlbedo(cosI, s.sheen.alpha));
    return 1.0 - largestOf(s.sheen.color) * min(e, 1.0);
}

// f |cos| of sheen. The authors' fit reflects more than it receives at grazing angles below a roughness of 0.3; this takes
// that back.
vec3 evalSheen(Sheen sheen, vec3 wo, vec3 wi) {
    const float e = max(charlieAlbedo(wo.z, sheen.alpha), charlieAlbedo(wi.z, sheen.alpha));
    return sheen.color * (evalCharlie(sheen.alpha, wo, wi) / max(1.0, e));
}

// Share of the light from wo that each lobe sends anywhere.
struct LobeAlbedos {
    vec3 diffuse;
    vec3 through;
    vec3 specular;
    vec3 sheen;
    float glass;
    float clearcoat;
};

LobeAlbedos baseAlbedos(Surface s, vec3 wo) {
    LobeAlbedos a = LobeAlbedos(s.diffuse, s.through, vec3(0.0), vec3(0.0), s.glassShare, 0.0);
    if (!hasSpecular(s))
        return a;
    const vec2 terms = specularAlbedoTerms(wo.z, alphaTowards(s, wo));
    const float rest = max(0.0, 1.0 - dot(s.coating, terms));
    a.diffuse *= rest;
    a.through *= rest;
    if (hasMultiple(s))
        a.diffuse += s.multiple * maskingLoss(s, wo);
    a.specular = s.specular.f0 * terms.x + s.specular.f90 * terms.y;
    if (sceneHas(kFeatureIridescence) && s.specular.film.weight > 0.0)
        a.specular = specularFresnel(s.specular, wo.z) * (terms.x + terms.y);
    return a;
}

LobeAlbedos lobeAlbedos(Surface s, vec3 wo) {
    LobeAlbedos a = baseAlbedos(s, wo);
    if (!hasClearcoat(s) && !hasSheen(s))
        return a;
    const float sheen = hasSheen(s) ? min(charlieAlbedo(wo.z, s.sheen.alpha), 1.0) : 0.0;
    const float belowCoat = throughClearcoat(s, wo, wo);
    const float below = belowCoat * (1.0 - largestOf(s.sheen.color) * sheen);
    return LobeAlbedos(below * a.diffuse, below * a.through, below * a.specular, belowCoat * sheen * s.sheen.color,
                       below * a.glass, 1.0 - belowCoat);
}

// What roulette by albedo goes by: base colour for Lambert, F0 for metal, 1 for glass, the tabulated albedo for layers.
vec3 directionalAlbedo(Surface s, vec3 wo) {
    if ((!sceneHas(kFeatureSpecular) || s.coating.y <= 0.0) && !hasClearcoat(s) && !hasSheen(s))
        return s.diffuse + s.through + s.specular.f0 + s.glassShare;
    const LobeAlbedos a = lobeAlbedos(s, wo);
    return a.diffuse + a.through + a.specular + a.sheen + a.glass + a.clearcoat;
}
