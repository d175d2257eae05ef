// Counts for the ledger.
#include "lib/features.glsl"
#include "shared/bindings.h"
#include "shared/film.h"

layout(set = 0, binding = BINDING_TALLIES, std430) buffer Tallies { uint tallies[]; };

// Adds to a 64-bit count in two words.
void addTally(uint which, uint amount) {
    const uint before = atomicAdd(tallies[2u * which], amount);
    if (before + amount < before)
        atomicAdd(tallies[2u * which + 1u], 1u);
}

// The mean of a path's throughput in units of 2^-16, below 2^28: a lane's sum over the 16 vertices of a dispatch fits a word.
uint fixedThroughput(vec3 throughput) {
    return uint(min(dot(throughput, vec3(1.0 / 3.0)), 4095.9) * 65536.0 + 0.5);
}

// Paths that were within more solids than their lists hold, and the highest number of one of these: an example, the same in
// every run.
void tallyCrowded(uint paths, uint solid) {
    if (sceneHas(kFeatureSolids) && paths > 0u) {
        addTally(kTallyCrowded, paths);
        atomicMax(tallies[2u * kTallyCrowdedSolid], solid);
    }
}

// Paths that --max-bounces ended although they could go on, and the sum of what they carried.
void tallyCutPaths(uint paths, uint throughput) {
    if (paths > 0u) {
        addTally(kTallyCutPaths, paths);
        addTally(kTallyCutThroughput, throughput);
    }
}
