// Based on: Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018,
// section 4. Changed: the size of a cluster is the square of its box's diagonal, not the box's surface, which
// is nothing for lights in a row.
#include "light/light_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

namespace lavalight {
namespace {

using std::numbers::pi;
using Ids = std::span<uint32_t>;

constexpr size_t kBuckets = 12; // along each axis, whose borders are the splits that are compared

// The solid angle of emission, weighted by the cosine to the nearest normal (equation 1).
double solidAngleMeasure(const LightCone& cone) {
    const double spread = cone.spread;
    const double reach = std::min(spread + cone.falloff, pi);
    return 2.0 * pi * (1.0 - std::cos(spread)) +
           0.5 * pi *
               (2.0 * reach * std::sin(spread) - std::cos(spread - 2.0 * reach) -
                2.0 * spread * std::sin(spread) + std::cos(spread));
}

double costOf(const LightBounds& bounds) {
    const glm::dvec3 diagonal = bounds.upper - bounds.lower;
    return bounds.intensity * solidAngleMeasure(bounds.cone) * glm::dot(diagonal, diagonal);
}

struct Split {
    int axis = 0;
    double lower = 0.0; // lower end of the centres' extent
    double extent = 0.0;
    size_t firstOfSecond = 0; // bucket
    double cost = std::numeric_limits<double>::infinity();

    [[nodiscard]] size_t bucketOf(const LightBounds& light) const {
        const double place = (light.center()[axis] - lower) / extent;
        return std::min(static_cast<size_t>(place * kBuckets), kBuckets - 1);
    }
};

using Buckets = std::array<std::optional<LightBounds>, kBuckets>;

void add(std::optional<LightBounds>& sum, const std::optional<LightBounds>& bounds) {
    if (sum && bounds)
        sum = unite(*sum, *bounds);
    else if (bounds)
        sum = bounds;
}

// Both sides' costs together, where the second side begins with each bucket; infinite where a side is empty.
std::array<double, kBuckets> splitCosts(const Buckets& buckets) {
    std::array<double, kBuckets> costs;
    costs.fill(std::numeric_limits<double>::infinity());
    std::array<std::optional<LightBounds>, kBuckets> first; // bounds of the buckets before each
    for (size_t i = 1; i < kBuckets; ++i) {
        first[i] = first[i - 1];
        add(first[i], buckets[i - 1]);
    }
    std::optional<LightBounds> second;
    for (size_t i = kBuckets - 1; i > 0; --i) {
        add(second, buckets[i]);
        if (first[i] && second)
            costs[i] = costOf(*first[i]) + costOf(*second);
    }
    return costs;
}

class Builder {
  public:
    explicit Builder(std::span<const LightBounds> lights) : lights_(lights) {
        tree_.paths.resize(lights.size());
        if (lights.empty())
            return;
        tree_.nodes.reserve(2 * lights.size() - 1);
        std::vector<uint32_t> ids(lights.size());
        std::iota(ids.begin(), ids.end(), 0u);
        tree_.nodes.emplace_back();
        build(0, ids, 0, 0);
    }

    LightTree take() { return std::move(tree_); }

  private:
    // Fills `node` with the lights of `ids`; `path` leads to the node.
    void build(size_t node, Ids ids, uint32_t path, uint32_t level) {
        if (ids.size() == 1) {
            tree_.nodes[node] = {lights_[ids[0]], true, ids[0]};
            tree_.paths[ids[0]] = path;
            return;
        }
        const size_t firstCount = partition(ids, kMostLightTreeLevels - level);
        const size_t children = tree_.nodes.size();
        tree_.nodes.resize(children + 2);
        build(children, ids.first(firstCount), path, level + 1);
        build(children + 1, ids.subspan(firstCount), path | 1u << level, level + 1);
        tree_.nodes[node] = {unite(tree_.nodes[children].bounds, tree_.nodes[children + 1].bounds), false,
                             static_cast<uint32_t>(children)};
    }

    // Sorts ids into two sides and returns the size of the first.
    size_t partition(Ids ids, uint32_t levelsLeft) const {
        const std::optional<Split> split = bestSplit(ids);
        const bool isTooDeep = static_cast<uint32_t>(std::bit_width(ids.size() - 1)) >= levelsLeft;
        if (!split || isTooDeep)
            return partitionByMedian(ids);
        const auto second = std::partition(ids.begin(), ids.end(), [&](uint32_t id) {
            return split->bucketOf(lights_[id]) < split->firstOfSecond;
        });
        return static_cast<size_t>(second - ids.begin());
    }

    // The cheapest split; nothing where all centres are the same.
    [[nodiscard]] std::optional<Split> bestSplit(Ids ids) const {
        const auto [lower, extent] = centreExtent(ids);
        const double widest = std::max({extent.x, extent.y, extent.z});
        Split best;
        for (int axis = 0; axis < 3; ++axis) {
            Split split{axis, lower[axis], extent[axis], 0, 0.0};
            if (!(split.extent > 0.0) || !std::isfinite(split.extent))
                continue;
            Buckets buckets;
            for (const uint32_t id : ids)
                add(buckets[split.bucketOf(lights_[id])], lights_[id]);
            const std::array<double, kBuckets> costs = splitCosts(buckets);
            for (size_t i = 1; i < kBuckets; ++i) {
                split.firstOfSecond = i;
                split.cost = costs[i] * widest / split.extent; // discourages thin slices (equation 2)
                if (split.cost < best.cost)
                    best = split;
            }
        }
        return best.firstOfSecond > 0 ? std::optional(best) : std::nullopt;
    }

    [[nodiscard]] std::pair<glm::dvec3, glm::dvec3> centreExtent(Ids ids) const {
        glm::dvec3 lower = lights_[ids[0]].center();
        glm::dvec3 upper = lower;
        for (const uint32_t id : ids) {
            lower = glm::min(lower, lights_[id].center());
            upper = glm::max(upper, lights_[id].center());
        }
        return {lower, upper - lower};
    }

    [[nodiscard]] size_t partitionByMedian(Ids ids) const {
        const glm::dvec3 extent = centreExtent(ids).second;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const size_t half = ids.size() / 2;
        std::nth_element(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(half), ids.end(),
                         [&](uint32_t a, uint32_t b) {
                             const double ca = lights_[a].center()[axis];
                             const double cb = lights_[b].center()[axis];
                             return ca != cb ? ca < cb : a < b; // ids decide ties
                         });
        return half;
    }

    std::span<const LightBounds> lights_;
    LightTree tree_;
};

} // namespace

LightTree buildLightTree(std::span<const LightBounds> lights) {
    return Builder(lights).take();
}

} // namespace lavalight
