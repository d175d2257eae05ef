// Sheen of cloth, fibres that stand up from the surface: sample, eval, pdf.
// Based on: Estevez, Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017 course notes; KHR_materials_sheen.
#include "lib/math/constants.glsl"
#include "lib/sampling/warp.glsl"

// Below this roughness the lobe is a rim that no image resolves, and the authors' fit of masking reflects several times
// what it receives.
const float kLeastSheenRoughness = 0.1;

struct Sheen {
    vec3 color;
    float alpha; // sheen roughness^2
};

// The distribution "Charlie": powers of the sine of the angle between facet and surface. Estevez, Kulla 2017, eq. 2.
float charlieD(float cosTheta, float alpha) {
    const float sin2 = max(0.0, 1.0 - cosTheta * cosTheta);
    return (2.0 + 1.0 / alpha) * pow(sin2, 0.5 / alpha) * 0.5 * kInvPi;
}

// Logarithm of Lambda up to 60 degrees from the horizon. Estevez, Kulla 2017, eq. 3 and table 1.
float charlieFit(float cosTheta, float alpha) {
    const float t = (1.0 - alpha) * (1.0 - alpha);
    const float a = mix(21.5473, 25.3245, t);
    const float b = mix(3.82987, 3.32435, t);
    const float c = mix(0.19823, 0.16801, t);
    const float d = mix(-1.97760, -1.27393, t);
    const float e = mix(-4.32054, -4.85967, t);
    return a / (1.0 + b * pow(cosTheta, c)) + d * cosTheta + e;
}

float charlieLambda(float cosTheta, float alpha) {
    const float low = charlieFit(max(0.0, min(cosTheta, 1.0 - cosTheta)), alpha);
    return exp(cosTheta < 0.5 ? low : 2.0 * charlieFit(0.5, alpha) - low);
}

// Draws all directions alike: as the lobe grows towards the horizon, their weights stay bounded and spread less than half as
// far as with directions by the cosine (measured: relative deviations of 0.2 to 1.9 against 0.5 to 7); facets drawn by D
// would mostly reflect below the horizon.
vec3 sampleSheen(vec2 u) {
    return squareToUniformHemisphere(u);
}

// f * |cos| of white sheen; the facets reflect everything.
float evalCharlie(float alpha, vec3 wo, vec3 wi) {
    const vec3 m = normalize(wo + wi);
    const float g2 = 1.0 / (1.0 + charlieLambda(wo.z, alpha) + charlieLambda(wi.z, alpha));
    return charlieD(m.z, alpha) * g2 / (4.0 * wo.z);
}

float pdfSheen(vec3 wi) {
    return squareToUniformHemispherePdf(wi.z);
}
