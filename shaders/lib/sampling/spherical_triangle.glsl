// Triangles as they are seen from a point: solid angle, and directions uniform over it.
// Based on: Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH 1995.
#include "lib/math/constants.glsl"

struct SphericalTriangle {
    vec3 a, b, c;     // unit vectors to the corners
    float cosC;       // cosine of the arc between a and b, Arvo's cos c
    float alpha;      // angle at a
    float solidAngle; // 0: too thin to be sampled
};

// Solid angle by the triple product, accurate for small triangles too: Van Oosterom, Strackee, "The Solid Angle of a Plane
// Triangle", 1983. a, b, c: unit vectors.
float solidAngleOf(vec3 a, vec3 b, vec3 c) {
    const float triple = abs(dot(a, cross(b, c)));
    const float denominator = 1.0 + dot(a, b) + dot(b, c) + dot(c, a);
    return 2.0 * atan(triple, denominator);
}

SphericalTriangle makeSphericalTriangle(vec3 a, vec3 b, vec3 c) {
    SphericalTriangle t;
    t.a = a;
    t.b = b;
    t.c = c;
    t.cosC = dot(a, b);
    const vec3 ab = cross(a, b);
    const vec3 ac = cross(a, c);
    t.alpha = atan(length(cross(ab, ac)), dot(ab, ac));
    t.solidAngle = solidAngleOf(a, b, c);
    return t;
}

// The unit part of x that is orthogonal to y.
vec3 orthogonalPart(vec3 x, vec3 y) {
    const vec3 o = x - dot(x, y) * y;
    return o * inversesqrt(max(dot(o, o), 1e-30));
}

// Arvo's algorithm: u.x picks the area of the subtriangle a b c', u.y the place on the arc from b to c'.
vec3 squareToSphericalTriangle(vec2 u, SphericalTriangle t) {
    const float area = u.x * t.solidAngle;
    const float s = sin(area - t.alpha);
    const float k = cos(area - t.alpha);
    const float cosAlpha = cos(t.alpha);
    const float sinAlpha = sin(t.alpha);
    const float p = k - cosAlpha;
    const float q = s + sinAlpha * t.cosC;
    const float numerator = (q * k - p * s) * cosAlpha - q;
    const float denominator = (q * s + p * k) * sinAlpha;
    const float cosB = denominator == 0.0 ? 1.0 : clamp(numerator / denominator, -1.0, 1.0);
    const vec3 onArc = cosB * t.a + sqrt(1.0 - cosB * cosB) * orthogonalPart(t.c, t.a);
    const float z = 1.0 - u.y * (1.0 - dot(onArc, t.b));
    return z * t.b + sqrt(max(0.0, 1.0 - z * z)) * orthogonalPart(onArc, t.b);
}
