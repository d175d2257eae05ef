// The origin of a scene, one axis at a time. Each part of the scene has a need, a length that has to be
// resolved well: its own size and the height of the image at its distance. The origin is where the largest
// ratio of a coordinate to its need is smallest: the centre of a weighted point set on a line.
#include "scene/scene_origin.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace lavalight {
namespace {

// A coordinate may be so many needs long before the origin moves: 19 of the 24 bits are left to the need. Of
// 319 sample models one reaches 4, and none 8.
constexpr double kMostNeeds = 32.0;

struct Part {
    VertexRun box;
    double need = 0.0; // metres
};

// A part without size has nothing to resolve.
std::vector<Part> partsOf(std::span<const VertexRun> runs, const std::optional<Viewpoint>& view) {
    VertexRun all;
    for (const VertexRun& run : runs) {
        all.lower = glm::min(all.lower, run.lower);
        all.upper = glm::max(all.upper, run.upper);
    }
    std::vector<Part> parts;
    double least = std::numeric_limits<double>::infinity();
    for (const VertexRun& run : runs) {
        if (!(run.size() > 0.0))
            continue;
        const double shown = view ? view->height + view->slope * run.distance(view->position) : all.size();
        parts.push_back({run, std::max(run.size(), shown)});
        least = std::min(least, parts.back().need);
    }
    if (view && !parts.empty())
        parts.push_back({{view->position, view->position}, least});
    return parts;
}

// The range of origins from which no coordinate is longer than `needs` times its part's need.
std::pair<double, double> originsFor(std::span<const Part> parts, glm::length_t axis, double needs) {
    std::pair range(-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
    for (const Part& part : parts) {
        range.first = std::max(range.first, part.box.upper[axis] - needs * part.need);
        range.second = std::min(range.second, part.box.lower[axis] + needs * part.need);
    }
    return range;
}

double bestOrigin(std::span<const Part> parts, glm::length_t axis, double mostNeeds) {
    double least = 0.0;
    std::pair best(0.0, 0.0);
    for (int halving = 0; halving < 60; ++halving) {
        const double needs = 0.5 * (least + mostNeeds);
        const auto range = originsFor(parts, axis, needs);
        if (range.first <= range.second) {
            best = range;
            mostNeeds = needs;
        } else {
            least = needs;
        }
    }
    return 0.5 * (best.first + best.second);
}

} // namespace

Viewpoint viewpointOf(const Camera& camera, const glm::dvec3& position) {
    if (camera.projection == Projection::orthographic)
        return {position, 2.0 * camera.halfHeight, 0.0};
    return {position, 0.0, 2.0 * std::tan(0.5 * camera.verticalFov)};
}

glm::dvec3 chooseOrigin(std::span<const VertexRun> runs, const std::optional<Viewpoint>& view) {
    const std::vector<Part> parts = partsOf(runs, view);
    glm::dvec3 most(0.0);
    double leastNeed = std::numeric_limits<double>::infinity();
    for (const Part& part : parts) {
        most = glm::max(most, glm::max(glm::abs(part.box.lower), glm::abs(part.box.upper)) / part.need);
        leastNeed = std::min(leastNeed, part.need);
    }
    glm::dvec3 origin(0.0);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        if (!(most[axis] > kMostNeeds))
            continue;
        // Few bits, so that taking it from a double leaves no rounding.
        const double step = std::exp2(std::floor(std::log2(leastNeed)));
        origin[axis] = std::round(bestOrigin(parts, axis, most[axis]) / step) * step;
    }
    return origin;
}

bool isCoarse(const VertexRun& run) {
    constexpr double kFewSteps = 128.0; // less than 1 % of the size is as good as exact
    return run.size() > 0.0 && run.size() < kFewSteps * resolutionAt(run.reach());
}

std::optional<CoarseGeometry> findCoarse(std::span<const VertexRun> runs) {
    std::optional<CoarseGeometry> worst;
    for (const VertexRun& run : runs) {
        const CoarseGeometry found{run.reach(), resolutionAt(run.reach()), run.size()};
        if (isCoarse(run) && (!worst || found.resolution > worst->resolution))
            worst = found;
    }
    return worst;
}

} // namespace lavalight
