// GGX microfacets with Smith's height-correlated masking and shadowing; local basis, z is the shading normal. alpha.x is the
// roughness along x, alpha.y along y: three multiplications more than one for both.
// Based on: Walter et al., "Microfacet Models for Refraction", EGSR 2007; Heitz, "Understanding the Masking-Shadowing
// Function", JCGT 3(2), 2014; Dupuy, Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023.
#include "lib/math/constants.glsl"
#include "shared/scene.h"

// D(m) of Walter 2007, eq. 33, stretched as in Heitz 2014, eq. 85, with m a unit vector.
float ggxD(vec3 m, vec2 alpha) {
    const float a2 = alpha.x * alpha.y;
    // a2 ((mx / ax)^2 + (my / ay)^2 + mz^2), written without cancellation near the peak.
    const vec3 v = vec3(alpha.y * m.x, alpha.x * m.y, a2 * m.z);
    const float k = a2 / dot(v, v);
    return a2 * k * k * kInvPi;
}

// Smith's Lambda; Heitz 2014, eqs. 72 and 80.
float ggxLambda(vec3 w, vec2 alpha) {
    const vec2 v = alpha * w.xy;
    return 0.5 * (sqrt(1.0 + dot(v, v) / (w.z * w.z)) - 1.0);
}

float ggxG1(vec3 w, vec2 alpha) {
    return 1.0 / (1.0 + ggxLambda(w, alpha));
}

// Height-correlated masking and shadowing; Heitz 2014, eq. 99.
float ggxG2(vec3 wo, vec3 wi, vec2 alpha) {
    return 1.0 / (1.0 + ggxLambda(wo, alpha) + ggxLambda(wi, alpha));
}

// Half vectors as they are visible from wo (wo.z > 0). Dupuy, Benyoub 2023, listing 3.
vec3 squareToVisibleNormal(vec2 u, vec3 wo, vec2 alpha) {
    const vec3 v = normalize(vec3(alpha * wo.xy, wo.z));
    const float phi = 2.0 * kPi * u.x;
    const float z = (1.0 - u.y) * (1.0 + v.z) - v.z;
    const float sinTheta = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    const vec3 h = vec3(sinTheta * cos(phi), sinTheta * sin(phi), z) + v;
    return normalize(vec3(alpha * h.xy, max(h.z, 1e-7)));
}

// Density of the half vector m per solid angle: D_v(m) = G1(wo) D(m) |wo.m| / wo.z.
float squareToVisibleNormalPdf(vec3 m, vec3 wo, vec2 alpha) {
    return ggxG1(wo, alpha) * ggxD(m, alpha) * max(0.0, dot(wo, m)) / wo.z;
}
