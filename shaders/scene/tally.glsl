// Counts for the ledger.
#include "shared/bindings.h"
#include "shared/film.h"

layout(set = 0, binding = BINDING_TALLIES, std430) buffer Tallies { uint tallies[]; };

// Adds to a 64-bit count in two words.
void addTally(uint which, uint amount) {
    const uint before = atomicAdd(tallies[2u * which], amount);
    if (before + amount < before)
        atomicAdd(tallies[2u * which + 1u], 1u);
}

// A path that --max-bounces ends although it could go on.
void tallyCutPath(vec3 throughput) {
    addTally(kTallyCutPaths, 1u);
    addTally(kTallyCutThroughput, uint(min(dot(throughput, vec3(1.0 / 3.0)), 65535.0) * 65536.0 + 0.5));
}
