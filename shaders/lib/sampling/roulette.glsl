// Russian roulette: the probability with which a path goes on.
// Based on: Arvo, Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990; the albedo kinds as in the lecture.
#include "shared/frame.h"

// Survival by throughput stays below this, or a path between white walls would never end.
const float kMaxSurvival = 0.95;

// Survival by the kinds whose probability is known before the next direction is drawn. 1 where nothing can be killed: the
// caller must not divide then.
float survivalByAlbedo(uint kind, float constantProbability, vec3 albedo) {
    if (kind == kRouletteConstant)
        return constantProbability;
    if (kind == kRouletteMeanAlbedo)
        return clamp(dot(albedo, vec3(1.0 / 3.0)), 0.1, 0.9);
    if (kind == kRouletteMaxAlbedo)
        return clamp(max(albedo.x, max(albedo.y, albedo.z)), 0.0, 1.0);
    return 1.0;
}

// Up to this vertex, kRouletteCbrtThroughput lets all paths go on from smooth surfaces. Beyond it, paths that are caught in
// glass end before --max-bounces cuts them.
const uint kMostSpared = 32u;

// Survival by the kinds that go by what the path carries: `throughput` after the next direction is drawn, without the scaling
// by eta^2 that radiance undergoes inside glass. Roots kill less: a path that dies early costs more in variance than it saves.
// The square root is that of Cycles; the cube root takes the least time to an equal error (docs/notes/performance.md).
float survivalByThroughput(uint kind, vec3 throughput) {
    const float largest = max(throughput.x, max(throughput.y, throughput.z));
    if (kind == kRouletteThroughput)
        return min(largest, kMaxSurvival);
    if (kind == kRouletteSqrtThroughput)
        return min(sqrt(largest), kMaxSurvival);
    if (kind == kRouletteCbrtThroughput)
        return min(pow(largest, 1.0 / 3.0), kMaxSurvival);
    return 1.0;
}

// Whether a path goes on from this vertex in any case. Behind a mirror or glass is light that no shadow ray finds: few paths
// bring it, and each of them much.
bool isSpared(uint kind, uint vertex, bool isSmooth) {
    return kind == kRouletteCbrtThroughput && isSmooth && vertex <= kMostSpared;
}
