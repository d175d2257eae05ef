// Dielectric interface or thin wall, smooth or rough: sample, eval, pdf. wi.z < 0 is the other side.
// Based on: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007. Radiance changes by
// 1 / eta^2 on its way through an interface; the weights include that (Veach 1997, section 5.2).
#include "lib/estimator.glsl"
#include "lib/features.glsl"
#include "lib/bsdf/fresnel.glsl"
#include "lib/bsdf/microfacet.glsl"
#include "lib/bsdf/thin_film.glsl"

struct Glass {
    vec3 color;  // tint of what passes through
    vec2 alpha;
    float eta;   // index on the other side / index on the side of wo; thin wall: of its material / outside
    bool isThin; // a wall without inside: light passes straight, spread as by reflection and mirrored
    Film film;   // film on the outside
};

// Reflectance; equal in all channels unless a film colours it.
vec3 glassFresnel(Glass g, float cosTheta) {
    const float plain =
        kFresnel == kFresnelSchlick ? schlickDielectric(cosTheta, g.eta) : fresnelDielectric(cosTheta, g.eta);
    if (!sceneHas(kFeatureIridescence) || g.film.weight <= 0.0 || plain == 1.0)
        return vec3(plain);
    // From inside as from outside at the angle that light leaves with: what has no losses reflects alike both ways.
    const float cosOutside =
        g.eta < 1.0 ? sqrt(max(0.0, 1.0 - (1.0 - cosTheta * cosTheta) / (g.eta * g.eta))) : cosTheta;
    const float r = (g.eta - 1.0) / (g.eta + 1.0);
    return mix(vec3(plain), filmReflectance(g.film, vec3(r * r), cosOutside), g.film.weight);
}

// Probability with which reflection is drawn.
float reflectionProbability(vec3 fresnel) {
    return sceneHas(kFeatureIridescence) ? (fresnel.x + fresnel.y + fresnel.z) * (1.0 / 3.0) : fresnel.x;
}

// Direction through a facet m with wo.m > 0, by Snell's law; only where there is no total internal reflection.
vec3 throughFacet(Glass g, vec3 wo, vec3 m) {
    const float cosO = dot(wo, m);
    if (g.isThin)
        return reflect(-wo, m) * vec3(1.0, 1.0, -1.0);
    const float cosT = sqrt(max(0.0, 1.0 - (1.0 - cosO * cosO) / (g.eta * g.eta)));
    return normalize((cosO / g.eta - cosT) * m - wo / g.eta);
}

// Radiance factor of passing through.
vec3 passColor(Glass g) {
    return g.isThin ? g.color : g.color / (g.eta * g.eta);
}

// The facet that takes wo to wi, on the side of wo.
vec3 facetBetween(Glass g, vec3 wo, vec3 wi) {
    vec3 m = wo + wi;
    if (wi.z < 0.0)
        m = g.isThin ? wo + wi * vec3(1.0, 1.0, -1.0) : wo + g.eta * wi;
    m = normalize(m);
    return m.z < 0.0 ? -m : m;
}

// d(facet) / d(wi): how densely directions around wi come from facets. Walter 2007, eqs. 14 and 17.
float facetJacobian(Glass g, vec3 wo, vec3 wi, vec3 m) {
    if (wi.z > 0.0 || g.isThin)
        return 1.0 / (4.0 * max(dot(wo, m), 1e-20));
    const float denominator = dot(wi, m) + dot(wo, m) / g.eta;
    return abs(dot(wi, m)) / max(denominator * denominator, 1e-20);
}

bool isFacetSeen(Glass g, vec3 wo, vec3 wi, vec3 m) {
    if (dot(wo, m) <= 0.0)
        return false;
    return wi.z > 0.0 || g.isThin || dot(wi, m) < 0.0;
}

// Draws wi: u.xy the facet, v whether it reflects; 0 if it is lost to masking, on the wrong side. Smooth glass is a delta
// lobe: m is the normal.
vec3 sampleGlass(Glass g, vec3 wo, vec2 u, float v) {
    const vec3 m = g.alpha.x < kSmoothAlpha ? vec3(0.0, 0.0, 1.0) : squareToVisibleNormal(u, wo, g.alpha);
    const bool reflects = v < reflectionProbability(glassFresnel(g, dot(wo, m)));
    const vec3 wi = reflects ? reflect(-wo, m) : throughFacet(g, wo, m);
    return reflects == (wi.z > 0.0) ? wi : vec3(0.0);
}

// f |cos| / pdf of smooth glass, whose wi was drawn.
vec3 smoothGlassWeight(Glass g, vec3 wo, vec3 wi) {
    const vec3 f = glassFresnel(g, wo.z);
    const float p = reflectionProbability(f);
    return wi.z > 0.0 ? f / p : passColor(g) * (1.0 - f) / (1.0 - p);
}

// f |cos| of rough glass.
vec3 evalGlass(Glass g, vec3 wo, vec3 wi) {
    const vec3 m = facetBetween(g, wo, wi);
    if (!isFacetSeen(g, wo, wi, m))
        return vec3(0.0);
    const vec3 f = glassFresnel(g, dot(wo, m));
    const vec3 share = wi.z > 0.0 ? f : passColor(g) * (1.0 - f);
    const vec3 upper = vec3(wi.xy, abs(wi.z));
    return share * (ggxD(m, g.alpha) * ggxG2(wo, upper, g.alpha) * dot(wo, m) / wo.z * facetJacobian(g, wo, wi, m));
}

float pdfGlass(Glass g, vec3 wo, vec3 wi) {
    const vec3 m = facetBetween(g, wo, wi);
    if (!isFacetSeen(g, wo, wi, m))
        return 0.0;
    const float f = reflectionProbability(glassFresnel(g, dot(wo, m)));
    return (wi.z > 0.0 ? f : 1.0 - f) * squareToVisibleNormalPdf(m, wo, g.alpha) * facetJacobian(g, wo, wi, m);
}
