// Multiple importance sampling weights for two techniques.
// Based on: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, sections 9.2.2 and 9.2.3.
#include "shared/frame.h"

// Weight of a sample drawn with density `own` where the other technique would have drawn it with density `other`, in
// the same measure. `kind` is one of kMis...; kMisOff stands for "the other technique does not count": 1.
float misWeight(uint kind, float own, float other) {
    if (kind == kMisOff)
        return 1.0;
    if (own <= 0.0)
        return 0.0;
    const float ratio = other / own; // divided first: densities of delta-like lobes overflow when squared
    return kind == kMisBalance ? 1.0 / (1.0 + ratio) : 1.0 / (1.0 + ratio * ratio);
}
