// From the binary tree to the cheapest wide one.
// Based on: Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs",
// 2017, section 3.1: dynamic programming over the number of children that a subtree gives to its wide node.
#include <algorithm>
#include <cassert>

#include "accel/build_tree.h"

namespace lavalight {

namespace {

// Cost of testing a node's boxes; triangleCost is relative to it.
constexpr double kNodeCost = 1.0;

double leafCost(const BuildNode& node, float triangleCost) {
    return node.box.area() * node.count * triangleCost;
}

// Two subtrees as `children` children: which share from the left is cheapest, and its cost.
double distribute(const Plan& left, const Plan& right, size_t children, uint8_t& share) {
    double best = std::numeric_limits<double>::infinity();
    for (size_t fromLeft = 1; fromLeft < children; ++fromLeft) {
        const double cost = left.cost[fromLeft - 1] + right.cost[children - fromLeft - 1];
        if (cost < best) {
            best = cost;
            share = static_cast<uint8_t>(fromLeft);
        }
    }
    return best;
}

Plan planInner(const BuildNode& node, float triangleCost) {
    const Plan& left = node.children[0]->plan;
    const Plan& right = node.children[1]->plan;
    Plan plan;
    std::array<double, kBvhWidth> distributed{};
    plan.share.fill(1); // stands where all costs are infinite
    for (size_t i = 1; i < kBvhWidth; ++i)
        distributed[i] = distribute(left, right, i + 1, plan.share[i]);
    const double asNode = node.box.area() * kNodeCost + distributed[kBvhWidth - 1];
    const double asLeaf = leafCost(node, triangleCost);
    plan.isLeaf = node.count <= kMaxLeafTriangles && asLeaf <= asNode;
    plan.cost[0] = plan.isLeaf ? asLeaf : asNode;
    plan.roots[0] = 1;
    for (size_t i = 1; i < kBvhWidth; ++i) {
        const bool more = distributed[i] < plan.cost[i - 1];
        plan.cost[i] = more ? distributed[i] : plan.cost[i - 1];
        plan.roots[i] = more ? static_cast<uint8_t>(i + 1) : plan.roots[i - 1];
    }
    return plan;
}

// Appends the subtree as at most `atMost` children.
void appendCheapest(const BuildNode& node, size_t atMost, std::vector<WideChild>& children) {
    const size_t roots = node.plan.roots[atMost - 1];
    if (roots == 1) {
        children.push_back({&node, node.plan.isLeaf});
        return;
    }
    const size_t share = node.plan.share[roots - 1];
    appendCheapest(*node.children[0], share, children);
    appendCheapest(*node.children[1], roots - share, children);
}

} // namespace

void makeReference(BuildNode& node, uint32_t triangle, const BuildBox& box, float triangleCost) {
    node.box = box;
    node.triangle = triangle;
    node.plan.cost.fill(leafCost(node, triangleCost));
    node.plan.roots.fill(1);
}

void makeInner(BuildNode& node, const BuildNode& left, const BuildNode& right, float triangleCost) {
    node.children = {&left, &right};
    node.box = left.box;
    node.box.extend(right.box);
    node.count = left.count + right.count;
    node.plan = planInner(node, triangleCost);
}

std::vector<WideChild> wideChildren(const BuildNode& node) {
    if (node.count == 1)
        return {{&node, true}};
    std::vector<WideChild> children;
    const size_t share = node.plan.share[kBvhWidth - 1];
    appendCheapest(*node.children[0], share, children);
    appendCheapest(*node.children[1], kBvhWidth - share, children);
    assert(children.size() <= kBvhWidth);
    return children;
}

} // namespace lavalight
