// Warps from the unit square, each with its density.
#include "lib/math/constants.glsl"

// Disk of radius 1, with equal areas and small distortion.
// Shirley, Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997.
vec2 squareToDisk(vec2 u) {
    const vec2 p = 2.0 * u - 1.0;
    if (p.x == 0.0 && p.y == 0.0)
        return vec2(0.0);
    const bool isWide = abs(p.x) > abs(p.y);
    const float radius = isWide ? p.x : p.y;
    const float angle = isWide ? 0.25 * kPi * (p.y / p.x) : 0.5 * kPi - 0.25 * kPi * (p.x / p.y);
    return radius * vec2(cos(angle), sin(angle));
}

float squareToDiskPdf() {
    return kInvPi;
}

// Hemisphere around +z by the cosine: Malley's method, the disk lifted to the hemisphere.
vec3 squareToCosineHemisphere(vec2 u) {
    const vec2 d = squareToDisk(u);
    return vec3(d, sqrt(max(0.0, 1.0 - dot(d, d))));
}

float squareToCosineHemispherePdf(float cosTheta) {
    return max(0.0, cosTheta) * kInvPi;
}

// Hemisphere around +z, all directions alike.
vec3 squareToUniformHemisphere(vec2 u) {
    const float r = sqrt(max(0.0, 1.0 - u.x * u.x));
    const float phi = 2.0 * kPi * u.y;
    return vec3(r * cos(phi), r * sin(phi), u.x);
}

float squareToUniformHemispherePdf(float cosTheta) {
    return cosTheta > 0.0 ? 0.5 * kInvPi : 0.0;
}

// Barycentrics (b1, b2) uniform over a triangle.
// Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
vec2 squareToTriangle(vec2 u) {
    if (u.y > u.x) {
        u.x *= 0.5;
        u.y -= u.x;
    } else {
        u.y *= 0.5;
        u.x -= u.y;
    }
    return u;
}

// Density per area, for a triangle of that area.
float squareToTrianglePdfArea(float area) {
    return 1.0 / area;
}

// Interval [0, 1] by a density linear from `first` to `last`, neither of them negative: the inverse of its integral, in the
// form that loses no digits where the two are equal. Uniform where both are 0.
float unitToLinear(float u, float first, float last) {
    const float sum = first + last;
    const float a = sum > 0.0 ? first / sum : 0.5;
    const float b = 1.0 - a;
    return min(u / max(a + sqrt(mix(a * a, b * b, u)), 1e-30), 1.0); // u = 0 and a = 0: no division by 0
}

float unitToLinearPdf(float x, float first, float last) {
    const float sum = first + last;
    return sum > 0.0 ? 2.0 * mix(first, last, x) / sum : 1.0;
}
