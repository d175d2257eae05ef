// Adds up what the invocations of a kernel visited in the accelerator.
#include "scene/intersect.glsl"
#include "shared/bindings.h"

layout(set = 0, binding = BINDING_VISIT_COUNTS, std430) buffer Visits { VisitCounts visits; };

void tallyVisits() {
    if (kCountVisits) {
        atomicAdd(visits.nodes, visited.nodes);
        atomicAdd(visits.triangles, visited.triangles);
    }
}
