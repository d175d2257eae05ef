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
    float eta;   // index on the other side / index on the side of wo; thin wall: of its material / outside; 0: all is reflected
    bool isThin; // a wall without inside: light passes straight, spread as by reflection and mirrored
    Film film;   // film on the outside
};

// The index beyond an interface / the one on this side. 0 in a file is an infinite one, on either side a mirror.
float relativeIndex(float beyond, float here) {
    return beyond > 0.0 && here > 0.0 ? beyond / here : 0.0;
}

bool hasFilm(Glass g) {
    return sceneHas(kFeatureIridescence) && g.film.weight > 0.0;
}

// Where indices match there is no boundary: light goes on as it came, whatever the roughness. A thin wall's spread does not
// follow from its index, so that it is brought to nothing over the last thousandth: the wall fades, and does not jump.
Glass makeGlass(vec3 color, vec2 alpha, float eta, bool isThin, Film film) {
    Glass g = Glass(color, alpha, eta, isThin, film);
    const float difference = abs(eta - 1.0);
    if (hasFilm(g) || (isThin ? difference >= 1e-3 : difference > 0.0))
        return g;
    const float left = isThin ? alpha.x * difference * 1e3 : 0.0;
    g.alpha = left < kSmoothAlpha ? vec2(0.0) : max(alpha * difference * 1e3, kSmoothAlpha);
    return g;
}

// Reflectance; equal in all channels unless a film colours it.
vec3 glassFresnel(Glass g, float cosTheta) {
    if (g.eta <= 0.0)
        return vec3(1.0);
    const float plain = g.eta == 1.0                ? 0.0
                        : kFresnel == kFresnelSchlick ? schlickDielectric(cosTheta, g.eta)
                                                      : fresnelDielectric(cosTheta, g.eta);
    if (!hasFilm(g) || plain == 1.0)
        return vec3(plain);
    // From inside as from outside at the angle that light leaves with: what has no losses reflects alike both ways.
    const float cosOutside = g.eta < 1.0 ? sqrt(max(0.0, cos2Beyond(cosTheta, g.eta))) : cosTheta;
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
    const float cosT = sqrt(max(0.0, cos2Beyond(cosO, g.eta)));
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

// Nearly matching indices bend so little that what passes is as narrow as a delta: alpha times the difference of the indices
// is its width. Facets are found from directions with an error of 1e-7 / difference, which must be far below alpha.
const float kNarrowestPass = 1e-4;

// Whether light that is drawn towards wi counts as a delta: light sampling cannot find it.
bool isDeltaGlass(Glass g, vec3 wi) {
    if (g.alpha.x < kSmoothAlpha)
        return true;
    return wi.z < 0.0 && !g.isThin && g.alpha.x * abs(g.eta - 1.0) < kNarrowestPass;
}

// Whether rough glass sends light to wi by the facet m.
bool isFacetSeen(Glass g, vec3 wo, vec3 wi, vec3 m) {
    if (dot(wo, m) <= 0.0 || isDeltaGlass(g, wi) || (wi.z < 0.0 && g.eta <= 0.0))
        return false;
    return wi.z > 0.0 || g.isThin || dot(wi, m) < 0.0;
}

// Smooth glass is a delta lobe, whose facet is the surface.
vec3 sampleFacet(Glass g, vec3 wo, vec2 u) {
    return g.alpha.x < kSmoothAlpha ? vec3(0.0, 0.0, 1.0) : squareToVisibleNormal(u, wo, g.alpha);
}

// Draws wi: u.xy the facet, v whether it reflects; 0 if it is lost to masking, on the wrong side.
vec3 sampleGlass(Glass g, vec3 wo, vec2 u, float v) {
    const vec3 m = sampleFacet(g, wo, u);
    const bool reflects = v < reflectionProbability(glassFresnel(g, dot(wo, m)));
    const vec3 wi = reflects ? reflect(-wo, m) : throughFacet(g, wo, m);
    return reflects == (wi.z > 0.0) ? wi : vec3(0.0);
}

// f |cos| / pdf of a facet, of which wi was drawn: what reflects or passes over the probability of drawing that.
vec3 facetWeight(Glass g, float cosO, vec3 wi) {
    const vec3 f = glassFresnel(g, cosO);
    const float p = reflectionProbability(f);
    return wi.z > 0.0 ? f / p : passColor(g) * (1.0 - f) / (1.0 - p);
}

// f |cos| / pdf of smooth glass, whose wi was drawn.
vec3 smoothGlassWeight(Glass g, vec3 wo, vec3 wi) {
    return facetWeight(g, wo.z, wi);
}

// f |cos| / pdf where isDeltaGlass() holds of rough glass, whose wi was drawn with u. It needs no density: facets are drawn
// by G1, and G2 of them are seen from both sides.
vec3 narrowGlassWeight(Glass g, vec3 wo, vec2 u, vec3 wi) {
    if (g.alpha.x < kSmoothAlpha)
        return smoothGlassWeight(g, wo, wi);
    const float seen = ggxG2(wo, vec3(wi.xy, abs(wi.z)), g.alpha) / ggxG1(wo, g.alpha);
    return seen * facetWeight(g, dot(wo, sampleFacet(g, wo, u)), wi);
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
