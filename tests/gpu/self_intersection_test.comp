#version 460
// Follows rays to their first hit and starts two more there: one away from the surface, one through it.
#include "lib/math/onb.glsl"
#include "lib/sampling/sampler.glsl"
#include "scene/interaction.glsl"
#include "scene/intersect.glsl"

struct Answer {
    float t;          // of the first ray; infinite: it missed
    float sameSideT;  // of a ray to the side that the first came from
    float otherSideT; // of the ray to the other side
};

layout(local_size_x = 64) in;
layout(set = 0, binding = 20, std430) readonly buffer In { Ray rays[]; };
layout(set = 0, binding = 21, std430) writeonly buffer Out { Answer answers[]; };

// Uniform over the hemisphere, so that grazing directions are common.
vec3 hemisphereDirection(vec2 u, vec3 n) {
    const float sinTheta = sqrt(max(0.0, 1.0 - u.x * u.x));
    return toWorld(makeBasis(n), vec3(sinTheta * cos(2.0 * kPi * u.y), sinTheta * sin(2.0 * kPi * u.y), u.x));
}

float firstHit(Interaction surface, vec3 direction) {
    const vec3 origin = offsetOrigin(surface.p, surface.pError, surface.ng, direction);
    Hit hit;
    const bool found =
        intersectClosest(origin, direction, kInfinity, RayFilter(false, surface.id, kNoSurface, 0u), hit);
    return found ? hit.t : kInfinity;
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= answers.length())
        return;
    const Ray ray = rays[i];
    Hit hit;
    if (!intersectClosest(ray.origin, ray.direction, kInfinity, RayFilter(false, kNoSurface, kNoSurface, 0u), hit)) {
        answers[i] = Answer(kInfinity, kInfinity, kInfinity);
        return;
    }
    const Interaction surface = makeInteraction(hit, -ray.direction);
    const vec2 u = sample2D(SampleKey(1u, i, 0u, 1u), kDimensionBsdf);
    const vec3 direction = hemisphereDirection(u, surface.ng);
    answers[i] = Answer(hit.t, firstHit(surface, direction), firstHit(surface, -direction));
}
