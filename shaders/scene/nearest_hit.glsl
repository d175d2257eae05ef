// The nearest hit that a traversal has found so far.
#include "scene/intersect.glsl"
#include "shared/wavefront.h"

struct NearestHit {
    Hit hit;
    SurfaceId surface; // decides where another triangle is hit at the same t
};

// No surface precedes the first: what is hit at tMax itself does not count.
NearestHit nothingBefore(float tMax) {
    return NearestHit(Hit(tMax, 0u, vec2(0.0)), SurfaceId(0u));
}
