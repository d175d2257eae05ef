#include "inspect/traced_fate.h"

#include <cmath>

namespace lavalight {

const char* fateOf(const TracedVertex& vertex) {
    if ((vertex.flags & kTracedGoesOn) != 0)
        return "goes on";
    if ((vertex.flags & kTracedCaught) != 0)
        return "caught by the ground";
    if (std::isinf(vertex.t))
        return "left the scene";
    if ((vertex.flags & kTracedCut) != 0)
        return "cut by --max-bounces";
    return vertex.survival < 1.0f ? "killed by roulette" : "absorbed";
}

} // namespace lavalight
