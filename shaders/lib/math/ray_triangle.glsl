// A watertight ray-triangle test: a ray that meets the common edge or corner of triangles hits at least one of them.
// Based on: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", 2013.
//
// The corners are moved to the ray's origin and sheared so that the ray becomes an axis; the signs of three edge
// functions then say on which side of each edge the ray passes. Two triangles compute the function of a common edge from
// the same two sheared corners in opposite order, which gives exactly opposite values as long as the compiler contracts
// nothing to a fused multiply-add: `precise`.
//
// The paper computes again in double where a function is 0. We need not: rounding is monotonic, so of two products the
// larger never rounds below the smaller, and an edge function's sign is right or lost to 0, never wrong. A zero counts as
// inside for either sign, so that a lost sign can make both neighbours report the hit, but never neither.
//
// Lengths of 1e-18 to 1e18 keep the products inside the range of normal floats.
#ifndef LAVALIGHT_RAY_TRIANGLE_GLSL
#define LAVALIGHT_RAY_TRIANGLE_GLSL

// A ray whose largest component of direction is turned into z.
struct ShearedRay {
    vec3 origin;
    vec3 shear; // direction.x / direction.z, direction.y / direction.z, 1 / direction.z, after turning
    bool xMain, yMain; // which component is the largest; z if neither
};

struct TriangleHit {
    float t;
    vec2 barycentrics; // b1, b2: the point is (1 - b1 - b2) v0 + b1 v1 + b2 v2
    bool front;        // seen from where v0, v1, v2 turn counter-clockwise
};

// A cyclic permutation, which keeps the sense of rotation.
vec3 turnMainToZ(ShearedRay ray, vec3 v) {
    return ray.xMain ? v.yzx : (ray.yMain ? v.zxy : v);
}

ShearedRay shearRay(vec3 origin, vec3 direction) {
    ShearedRay ray;
    vec3 size = abs(direction);
    ray.origin = origin;
    ray.xMain = size.x >= size.y && size.x >= size.z;
    ray.yMain = !ray.xMain && size.y >= size.z;
    vec3 turned = turnMainToZ(ray, direction);
    ray.shear = vec3(turned.xy, 1.0) / turned.z;
    return ray;
}

// The corner relative to the ray: x and y across it, z along it in units of t. Equal corners give equal bits.
vec3 shearCorner(ShearedRay ray, vec3 corner) {
    precise vec3 v = turnMainToZ(ray, corner - ray.origin);
    precise vec2 across = v.xy - ray.shear.xy * v.z;
    return vec3(across, ray.shear.z * v.z);
}

float edgeFunction(vec3 a, vec3 b) {
    precise float left = a.x * b.y;
    precise float right = a.y * b.x;
    precise float result = left - right;
    return result;
}

// True for a hit with t > 0.
bool intersectTriangle(ShearedRay ray, vec3 v0, vec3 v1, vec3 v2, out TriangleHit hit) {
    vec3 a = shearCorner(ray, v0);
    vec3 b = shearCorner(ray, v1);
    vec3 c = shearCorner(ray, v2);
    vec3 edges = vec3(edgeFunction(c, b), edgeFunction(a, c), edgeFunction(b, a)); // opposite of v0, v1, v2
    float determinant = edges.x + edges.y + edges.z;
    vec3 weights = edges * (1.0 / determinant);
    // Precise to a few 1e-7 of t, on slivers to 1e-4. The quotient that the plane gives is better there, but only with the
    // normal from the two shorter edges, and finding those measured 12 % of all rays' time.
    hit.t = dot(weights, vec3(a.z, b.z, c.z));
    hit.barycentrics = weights.yz;
    hit.front = (determinant > 0.0) == (ray.shear.z > 0.0);
    bool inside = all(greaterThanEqual(edges, vec3(0.0))) || all(lessThanEqual(edges, vec3(0.0)));
    return inside && determinant != 0.0 && hit.t > 0.0;
}

#endif
