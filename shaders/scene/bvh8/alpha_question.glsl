// A triangle that a ray has met and that may let it through. Traversal leaves its loop to ask: lavapipe executes all that
// stands in a loop, and would look up textures at every step.
#include "scene/alpha.glsl"
#include "scene/nearest_hit.glsl"
#include "scene/triangle_record.glsl"
#include "shared/wavefront.h"

struct AlphaQuestion {
    bool isOpen;
    Hit candidate;
    uint passed; // bit i: triangle i of the leaf at hand has let the ray through
};

const AlphaQuestion kNoQuestion = AlphaQuestion(false, Hit(0.0, 0u, vec2(0.0)), 0u);

// Takes a triangle of the leaf that starts at `first` for a candidate, unless it has answered.
void askAlpha(Hit candidate, uint first, inout AlphaQuestion question) {
    if ((question.passed >> (candidate.record - first) & 1u) == 0u) {
        question.isOpen = true;
        question.candidate = candidate;
    }
}

// Returns whether the candidate stops the ray, and then takes it for the nearest.
bool answerAlpha(uint first, uint seed, inout AlphaQuestion question, inout NearestHit nearest) {
    const bool wasOpen = question.isOpen;
    const Hit candidate = question.candidate;
    const vec3 b = vec3(1.0 - candidate.barycentrics.x - candidate.barycentrics.y, candidate.barycentrics);
    question.isOpen = false;
    const TriangleRecord triangle = loadTriangle(candidate.record);
    if (wasOpen && letsThrough(triangle, b, seed)) {
        question.passed |= 1u << (candidate.record - first);
        return false;
    }
    if (!wasOpen || !comesFirst(candidate.t, triangle.surface, nearest.hit.t, nearest.surface))
        return false;
    nearest = NearestHit(candidate, triangle.surface);
    return true;
}
