// Based on: Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018,
// section 4. Changed: the size of a cluster is the square of its box's diagonal, not the box's surface, which
// is nothing for lights in a row. Nodes have eight children, those of a binary tree: the more are compared at
// once, the more exactly a pick follows what lights bring.
#include "light/light_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "shared/scene.h"

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

// A node of two children, which are neighbours.
struct BinaryNode {
    LightBounds bounds;
    uint32_t height = 0; // levels below; 0: a leaf
    uint32_t index = 0;  // leaf: the light; else the first child
};

// Three of its levels make one of the tree of eight children (opened()).
constexpr uint32_t kMostBinaryLevels = kLightTreeChildBits * kMostLightTreeLevels;

class BinaryBuilder {
  public:
    explicit BinaryBuilder(std::span<const LightBounds> lights) : lights_(lights) {
        nodes_.reserve(2 * lights.size() - 1);
        std::vector<uint32_t> ids(lights.size());
        std::iota(ids.begin(), ids.end(), 0u);
        nodes_.emplace_back();
        build(0, ids, 0);
    }

    std::vector<BinaryNode> take() { return std::move(nodes_); }

  private:
    // Fills `node` with the lights of `ids`.
    void build(size_t node, Ids ids, uint32_t level) {
        if (ids.size() == 1) {
            nodes_[node] = {lights_[ids[0]], 0, ids[0]};
            return;
        }
        const size_t firstCount = partition(ids, kMostBinaryLevels - level);
        const size_t children = nodes_.size();
        nodes_.resize(children + 2);
        build(children, ids.first(firstCount), level + 1);
        build(children + 1, ids.subspan(firstCount), level + 1);
        const BinaryNode& first = nodes_[children];
        const BinaryNode& second = nodes_[children + 1];
        nodes_[node] = {unite(first.bounds, second.bounds), 1 + std::max(first.height, second.height),
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
    std::vector<BinaryNode> nodes_;
};

// Takes a binary tree's nodes eight at a time.
class Collapse {
  public:
    explicit Collapse(std::vector<BinaryNode> nodes) : nodes_(std::move(nodes)) {
        tree_.paths.resize((nodes_.size() + 1) / 2); // one for each leaf
        tree_.nodes.emplace_back();
        collapse(0, 0, 0, 0);
    }

    LightTree take() { return std::move(tree_); }

  private:
    // Fills the node at `to` with what is below `from`; `path` leads there.
    void collapse(size_t to, uint32_t from, uint32_t path, uint32_t level) {
        const BinaryNode& node = nodes_[from];
        if (node.height == 0) {
            tree_.nodes[to] = {node.bounds, true, node.index};
            tree_.paths[node.index] = path;
            return;
        }
        const size_t first = tree_.nodes.size();
        tree_.nodes[to] = {node.bounds, false, static_cast<uint32_t>(first)};
        tree_.nodes.resize(first + kLightTreeWidth);
        const std::vector<uint32_t> children = opened(from);
        for (uint32_t i = 0; i < children.size(); ++i)
            collapse(first + i, children[i], path | i << (kLightTreeChildBits * level), level + 1);
    }

    // The node's children, of which the highest, and among these the brightest, gives its place to its own
    // until there are eight. All of them are three levels lower than the node, at least: only the seven nodes
    // of its first three levels can be higher, and they are the first to give their places away.
    [[nodiscard]] std::vector<uint32_t> opened(uint32_t node) const {
        std::vector<uint32_t> open{node};
        while (open.size() < kLightTreeWidth) {
            const auto highest = std::ranges::max_element(open, {}, [&](uint32_t i) {
                return std::pair(nodes_[i].height, nodes_[i].bounds.intensity);
            });
            if (nodes_[*highest].height == 0)
                break;
            const uint32_t child = nodes_[*highest].index;
            *highest = child;
            open.insert(highest + 1, child + 1);
        }
        return open;
    }

    std::vector<BinaryNode> nodes_;
    LightTree tree_;
};

} // namespace

LightTree buildLightTree(std::span<const LightBounds> lights) {
    if (lights.empty())
        return {};
    return Collapse(BinaryBuilder(lights).take()).take();
}

} // namespace lavalight
