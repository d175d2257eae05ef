// The rays of a path: from the camera, between vertices, and to lights.
#include "lib/camera.glsl"
#include "lib/interior_list.glsl"
#include "lib/math/ray_offset.glsl"
#include "lib/sampling/pixel_filter.glsl"
#include "scene/alpha.glsl"
#include "scene/frame.glsl"
#include "scene/intersect.glsl"

const Path kNewPath = Path(vec3(1.0), 0.0, vec3(0.0), 1.0);

// Through a random point of the slot's pixel, drawn by the pixel filter, and of the lens.
Ray cameraRayOf(uint slot) {
    const uint pixel = pixelOfSlot(slot);
    const vec2 corner = vec2(pixel % frame.imageWidth, pixel / frame.imageWidth);
    const SampleKey key = keyOfSlot(slot, 0u);
    const vec2 lens = sceneHas(kFeatureLens) ? sample2D(key, kDimensionLens) : vec2(0.0);
    const vec2 u = sample2D(key, kDimensionPixel);
    const bool isFiltered = sceneHas(kFeatureFilter) && frame.hasFilter != 0u;
    return cameraRay(frame, corner + (isFiltered ? filteredPosition(frame, u) : u), lens);
}

// Where a ray meets the boundary of a solid, and where it meets none.
struct Boundary {
    uint solid;   // or 0
    bool isFront; // the ray comes from outside
    SurfaceId surface;
    vec3 p;
    vec3 ng;      // on the side where the ray comes from
    float nearby; // distance within which rounding cannot tell two surfaces apart
};

Boundary boundaryAt(Hit hit, vec3 direction) {
    const TriangleRecord triangle = loadTriangle(hit.record);
    const vec3 b = vec3(1.0 - hit.barycentrics.x - hit.barycentrics.y, hit.barycentrics);
    const vec3 ng = normalize(cross(triangle.v1 - triangle.v0, triangle.v2 - triangle.v0));
    Boundary boundary;
    boundary.isFront = dot(ng, direction) < 0.0;
    boundary.solid = solidOf(triangle.surface);
    boundary.surface = triangle.surface;
    boundary.p = b.x * triangle.v0 + b.y * triangle.v1 + b.z * triangle.v2;
    boundary.ng = boundary.isFront ? ng : -ng;
    boundary.nearby = nearbyDistance(hitPointError(b, triangle.v0, triangle.v1, triangle.v2));
    return boundary;
}

// What is traced at a time of a ray among solids: a part of it, or a probe for a second boundary where it has met one.
struct Leg {
    vec3 origin;
    vec3 direction;
    float end;
};

const uint kLegToStart = 0u; // from the frame's reference to where the camera ray starts
const uint kLegOfRay = 1u;
const uint kLegProbe = 2u;
const uint kMostLegs = 256u; // of a ray; beyond, the boundary at hand counts as a vertex

Leg legToStart(Ray ray) {
    const vec3 way = ray.origin - frame.startReference;
    const float distance = length(way);
    return Leg(frame.startReference, distance > 0.0 ? way / distance : ray.direction, distance);
}

// The closest hit of a ray that keeps a list of solids. Boundaries that change no medium are passed here, without a vertex;
// the list follows. Where two boundaries coincide (a liquid that touches its glass), they are one: a probe along the normal
// finds the second, and the list notes it.
Hit traceAmongSolids(RayFilter ignored, float end, bool startsVary, inout Ray ray) {
    uint kind = startsVary ? kLegToStart : kLegOfRay;
    Leg leg = startsVary ? legToStart(ray) : Leg(ray.origin, ray.direction, end);
    float passed = 0.0;
    bool isNearStart = false;
    Hit hit = Hit(kInfinity, 0u, vec2(0.0));
    Boundary boundary;
    for (uint i = 0u; i < kMostLegs; ++i) {
        Hit met;
        const bool isMet = intersectClosest(leg.origin, leg.direction, leg.end, ignored, met);
        Boundary at;
        at.solid = 0u;
        if (isMet)
            at = boundaryAt(met, leg.direction);
        if (kind == kLegToStart) {
            if (isMet) {
                ray.interior = crossed(ray.interior, at.solid, at.isFront);
                ignored.firstSurface = at.surface;
                leg = Leg(at.p, leg.direction, leg.end - met.t);
            } else {
                kind = kLegOfRay;
                ignored.firstSurface = ray.fromSurface;
                leg = Leg(ray.origin, ray.direction, end);
            }
            continue;
        }
        if (kind == kLegOfRay) {
            hit = met;
            hit.t = isMet ? passed + met.t : kInfinity;
            if (at.solid == 0u)
                return hit;
            boundary = at;
            isNearStart = isSurface(ignored.firstSurface) && met.t * abs(dot(at.ng, leg.direction)) <= 2.0 * at.nearby;
            kind = kLegProbe;
            ignored.firstSurface = at.surface;
            leg = Leg(at.p + at.nearby * at.ng, -at.ng, 2.0 * at.nearby);
            continue;
        }
        // A surface that begins where the ray starts, and is entered already, is met a second time by rounding.
        const bool isAgain = isNearStart && boundary.isFront && interiorContains(ray.interior, boundary.solid);
        const bool touches = at.solid != 0u && (at.solid != boundary.solid || at.isFront != boundary.isFront);
        InteriorList list = ray.interior;
        if (touches)
            list = withTouching(list, at.solid, at.isFront);
        const InteriorList beyond = isAgain ? withoutRayNotes(ray.interior)
                                            : beyondBoundary(list, boundary.solid, boundary.isFront);
        if (solidAround(beyond) != solidAround(ray.interior)) {
            ray.interior = list;
            return hit;
        }
        ray.interior = beyond;
        ray.interior.notes |= kInteriorPassed;
        passed = hit.t;
        kind = kLegOfRay;
        ignored.firstSurface = boundary.surface;
        leg = Leg(boundary.p, ray.direction, end - passed);
    }
    return hit;
}

// glTF's back-face culling is for the camera alone: light transport needs closed surfaces.
bool cullsBackFaces(uint bounce) {
    return bounce == 0u;
}

RayFilter filterOf(uint slot, uint bounce, Ray ray) {
    return RayFilter(cullsBackFaces(bounce), ray.fromSurface, kNoSurface, alphaSeed(keyOfSlot(slot, bounce), kDimensionAlpha));
}

float endOf(uint bounce, Ray ray) {
    return bounce == 0u ? cameraRayEnd(frame, ray.direction) : kInfinity;
}

// The closest hit; t is infinite where there is none.
Hit trace(uint slot, uint bounce, inout Ray ray) {
    const RayFilter ignored = filterOf(slot, bounce, ray);
    const float end = endOf(bounce, ray);
    if (sceneHas(kFeatureSolids))
        return traceAmongSolids(ignored, end, sceneHas(kFeatureStartsVary) && bounce == 0u, ray);
    Hit hit;
    if (!intersectClosest(ray.origin, ray.direction, end, ignored, hit))
        hit.t = kInfinity;
    return hit;
}

// Whether the ground caught the path: what arrives by its shadow ray is light on the ground, not radiance of the path.
bool isCaught(Path path) {
    return sceneHas(kFeatureShadowCatcher) && path.etaScale == kCaught;
}

RayFilter shadowFilterOf(uint slot, uint bounce, ShadowRay ray) {
    return RayFilter(false, ray.fromSurface, ray.toSurface,
                     alphaSeed(keyOfSlot(slot, bounce + 1u), kDimensionShadowAlpha));
}

// Whether something stops the shadow ray of the vertex after `bounce` others.
bool isOccluded(ShadowRay ray, uint slot, uint bounce) {
    return intersectAny(ray.origin, ray.direction, 1.0, shadowFilterOf(slot, bounce, ray));
}
