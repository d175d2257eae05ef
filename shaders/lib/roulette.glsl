// Russian roulette: the probability with which a path goes on.
// Based on: Arvo, Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990.
#include "shared/frame.h"

// Survival by throughput stays below this, or a path between white walls would never end.
const float kMaxSurvival = 0.95;

// 1 where nothing can be killed: the caller must not divide then. `vertex` is 1 at the camera's first hit.
float survivalProbability(uint kind, uint vertex, uint firstVertex, vec3 throughput) {
    if (kind == kRouletteOff || vertex < firstVertex)
        return 1.0;
    return min(max(throughput.x, max(throughput.y, throughput.z)), kMaxSurvival);
}
