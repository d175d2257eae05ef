// Origins of secondary rays, moved off the surface by the hit point's own rounding error.
// Based on: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 6.8 (bounds on rounding errors).

// gamma(n) = n eps / (1 - n eps) with eps = 2^-24 bounds the relative error of n roundings in a row.
// Interpolating a point from barycentrics takes 7 (ibid., section 6.8.4); the intersection test that the new ray makes
// with the same or a coplanar triangle subtracts its origin from each vertex and interpolates t anew, as many again.
const float kHitPointGamma = 16.0 * 5.9604645e-8;

// Bound on the error of b0 v0 + b1 v1 + b2 v2 per component, in the unit of the positions. Relative to the vertices:
// no constant is absolute, so a scene may be a millimetre or a kilometre wide.
vec3 hitPointError(vec3 b, vec3 v0, vec3 v1, vec3 v2) {
    return kHitPointGamma * (abs(b.x * v0) + abs(b.y * v1) + abs(b.z * v2));
}

// Barycentrics with the point kept off the triangle's edges by the error of interpolating it (half of the bound above).
// Nearer to an edge it may come to lie on or beyond the neighbouring triangle, and rays from there leak: of a cube at ten
// thousand times its size from the origin, one in ten thousand. twiceArea: of the triangle.
vec3 keepOffEdges(vec3 b, vec3 error, float longestEdge, float twiceArea) {
    const float least = min(0.5 * length(error) * longestEdge / twiceArea, 1.0 / 3.0);
    const vec3 kept = max(b, vec3(least));
    return kept / (kept.x + kept.y + kept.z);
}

// The next float away from zero in the direction of `sign`, so that adding the offset cannot round back.
float nextFloat(float x, float sign) {
    if (sign == 0.0 || x == 0.0)
        return x;
    const int step = (x > 0.0) == (sign > 0.0) ? 1 : -1;
    return intBitsToFloat(floatBitsToInt(x) + step);
}

// The point on the side of `direction` where no rounding puts the surface in front again; ng: unit geometric normal.
vec3 offsetOrigin(vec3 p, vec3 error, vec3 ng, vec3 direction) {
    const float side = dot(direction, ng) < 0.0 ? -1.0 : 1.0;
    const vec3 offset = side * dot(abs(ng), error) * ng;
    const vec3 moved = p + offset;
    return vec3(nextFloat(moved.x, offset.x), nextFloat(moved.y, offset.y), nextFloat(moved.z, offset.z));
}

// Distance from a hit point, in metres, within which another surface may be the same one but for rounding: three units in the
// last place of the largest coordinate. A pane that is thicker has two sides.
float nearbyDistance(vec3 error) {
    return 0.375 * max(error.x, max(error.y, error.z));
}
