// Triangles that another program's traversal proposes: Embree's on the host, a graphics card's in kernels. Our own test
// decides where a ray meets them, and which comes first, so that all accelerators find the same. They differ only where a
// ray meets an edge so exactly that the two tests differ about its side.
#include "lib/math/ray_direction.glsl"
#include "lib/math/ray_triangle.glsl"
#include "scene/alpha.glsl"
#include "scene/nearest_hit.glsl"

// The distances of the two tests differ: by roundings, on slivers by up to 1e-4. What is a little beyond the nearest may
// come before it.
const float kProposalMargin = 2e-4;

const float kFarthest = 1e18; // largest component of an origin or a direction

float withMargin(float t) {
    return t * (1.0 + kProposalMargin);
}

// Whether a ray is one that other programs may be asked about: Embree ends the program for a ray that is not finite or
// starts beyond 1.8e18, which a camera at the end of the world may ask for. Such a ray meets nothing.
bool isTraceable(vec3 origin, vec3 direction) {
    return all(lessThanEqual(abs(origin), vec3(kFarthest))) && all(lessThanEqual(abs(direction), vec3(kFarthest)));
}

// Where the ray meets a triangle that is proposed at these barycentrics.
TriangleHit whereMet(ShearedRay ray, TriangleRecord triangle, vec2 proposed) {
    TriangleHit at;
    if (intersectTriangle(ray, triangle.v0, triangle.v1, triangle.v2, at))
        return at;
    vec3 weights = vec3(1.0 - at.barycentrics.x - at.barycentrics.y, at.barycentrics);
    if (at.t <= 0.0 && all(greaterThan(weights, vec3(-1e-5))))
        return at; // behind the origin, or at it
    const float sum = weights.x + weights.y + weights.z;
    if (isnan(sum) || isinf(sum)) // our test sees the triangle as a line
        weights = vec3(1.0 - proposed.x - proposed.y, proposed);
    // The two tests differ about the side of an edge: the nearest point of the triangle. Without this, a triangle that is
    // seen from its edge would be met far beside itself.
    weights = max(weights, vec3(0.0));
    weights /= weights.x + weights.y + weights.z;
    at.barycentrics = weights.yz;
    at.t = dot(weights, vec3(shearCorner(ray, triangle.v0).z, shearCorner(ray, triangle.v1).z,
                             shearCorner(ray, triangle.v2).z));
    return at;
}

// Whether a ray takes a triangle where it meets it, and is not let through.
bool takesMet(TriangleHit at, TriangleRecord triangle, RayFilter ignored) {
    if (passesThrough(ignored, triangle, at.front))
        return false;
    const vec3 b = vec3(1.0 - at.barycentrics.x - at.barycentrics.y, at.barycentrics);
    return !sceneHas(kFeatureAlpha) || (triangle.material & kAlphaBit) == 0u || !letsThrough(triangle, b, ignored.alphaSeed);
}

// Takes a proposed triangle, whose record has the number of its surface, for the nearest; false: it is not, or lets the
// ray through.
bool takesProposed(ShearedRay ray, uint record, vec2 proposed, RayFilter ignored, inout NearestHit nearest) {
    // passesThrough() would say so below, but most rays are offered the triangle that they start on.
    if (isSameSurface(SurfaceId(record), ignored.firstSurface) || isSameSurface(SurfaceId(record), ignored.secondSurface))
        return false;
    const TriangleRecord triangle = loadTriangle(record);
    const TriangleHit at = whereMet(ray, triangle, proposed);
    if (!(at.t > 0.0) || !comesFirst(at.t, triangle.surface, nearest.hit.t, nearest.surface) ||
        !takesMet(at, triangle, ignored))
        return false;
    nearest = NearestHit(Hit(at.t, record, at.barycentrics), triangle.surface);
    return true;
}
