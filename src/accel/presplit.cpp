// Splits large triangles before the tree is built, rather than within Embree's builder: its spatial splits
// took ten times as long to build a tree no faster to traverse, and Debian's Embree, compiled with its
// assertions, stops the program where a split that its bins promised leaves one side empty (one input of
// 2,000 random ones).
//
// Based on: Karras, Aila, "Fast Parallel Construction of High-Quality Bounding Volume Hierarchies", 2013,
// section 5.
#include "accel/presplit.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lavalight {

namespace {

// A convex part of a triangle.
using Polygon = std::vector<glm::dvec3>;

// Planes where a cube around the scene is halved again and again; nodes of the tree tend to end there.
struct Grid {
    static constexpr int kLevels = 20;
    glm::dvec3 origin{0.0};
    double cell = 0.0;

    explicit Grid(const Bounds& bounds) : origin(bounds.lower) {
        const glm::dvec3 extent = glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower);
        cell = std::max({extent.x, extent.y, extent.z}) / (1 << kLevels);
    }
};

struct Plane {
    int level = Grid::kLevels; // 0: through the middle of the scene
    int axis = 0;
    double position = 0.0;
};

// The plane of lowest level that cuts the box; level kLevels if none does.
Plane mainPlane(const Grid& grid, const BuildBox& box) {
    Plane best;
    for (int axis = 0; axis < 3; ++axis) {
        if (grid.cell <= 0.0)
            break;
        const auto inCells = [&](float x) { return (x - grid.origin[axis]) / grid.cell; };
        const auto first = static_cast<uint32_t>(inCells(box.lower[axis]));
        const auto end = static_cast<uint32_t>(std::ceil(inCells(box.upper[axis])));
        if (end <= first + 1)
            continue;
        const uint32_t last = end - 1; // a box that ends at a plane is not cut by it
        const int bit = std::bit_width(first ^ last) - 1;
        const double position = grid.origin[axis] + (last >> bit << bit) * grid.cell;
        const int level = Grid::kLevels - 1 - bit;
        if (level < best.level && box.lower[axis] < position && position < box.upper[axis])
            best = {level, axis, position};
    }
    return best;
}

// The nearest float that is not above `value`.
float roundDown(double value) {
    const auto nearest = static_cast<float>(value);
    return nearest > value ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
}

// Corners made by cuts are off by the roundings of doubles: `slack` is more than those.
BuildBox boxOf(const Polygon& polygon, const BuildBox& within) {
    BuildBox box;
    for (const glm::dvec3& p : polygon) {
        const glm::dvec3 slack = 0x1p-48 * glm::abs(p) + 0x1p-140;
        for (int axis = 0; axis < 3; ++axis) {
            box.lower[axis] = std::min(box.lower[axis], roundDown(p[axis] - slack[axis]));
            box.upper[axis] = std::max(box.upper[axis], -roundDown(-p[axis] - slack[axis]));
        }
    }
    return {glm::max(box.lower, within.lower), glm::min(box.upper, within.upper)};
}

// The part of a polygon where sign * (x - position) <= 0 on the plane's axis.
Polygon clip(const Polygon& polygon, const Plane& plane, double sign) {
    Polygon part;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double da = sign * (a[plane.axis] - plane.position);
        const double db = sign * (b[plane.axis] - plane.position);
        if (da <= 0.0)
            part.push_back(a);
        if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) {
            part.push_back(a + (b - a) * (da / (da - db)));
            part.back()[plane.axis] = plane.position;
        }
    }
    return part;
}

float longestSide(const BuildBox& box) {
    const glm::vec3 extent = box.upper - box.lower;
    return std::max({extent.x, extent.y, extent.z});
}

// Makes `splits` cuts, shared out between the two sides of each by their lengths.
void appendPieces(const Grid& grid, uint32_t triangle, const Polygon& polygon, const BuildBox& box,
                  uint32_t splits, std::vector<Fragment>& fragments) {
    const Plane plane = mainPlane(grid, box);
    if (splits == 0 || plane.level == Grid::kLevels) {
        fragments.push_back({triangle, box});
        return;
    }
    const Polygon left = clip(polygon, plane, 1.0);
    const Polygon right = clip(polygon, plane, -1.0);
    if (left.empty() || right.empty()) { // the plane runs through the slack of the box
        fragments.push_back({triangle, box});
        return;
    }
    const BuildBox leftBox = boxOf(left, box);
    const BuildBox rightBox = boxOf(right, box);
    const double share = longestSide(leftBox) / (double{longestSide(leftBox)} + longestSide(rightBox));
    const auto leftSplits = std::min(splits - 1, static_cast<uint32_t>(std::lround((splits - 1) * share)));
    appendPieces(grid, triangle, left, leftBox, leftSplits, fragments);
    appendPieces(grid, triangle, right, rightBox, splits - 1 - leftSplits, fragments);
}

// How much a split helps: area that the box has in vain, less where the plane is of a higher level (Karras
// and Aila's equation 3).
double priority(const Grid& grid, const Triangle& t) {
    const BuildBox box = triangleBox(t);
    const Plane plane = mainPlane(grid, box);
    if (plane.level == Grid::kLevels)
        return 0.0;
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(t.v1) - glm::dvec3(t.v0), glm::dvec3(t.v2) - glm::dvec3(t.v0));
    const double ideal = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
    return std::cbrt(std::ldexp(std::max(box.area() - ideal, 0.0), -plane.level));
}

// The factor with which the priorities, rounded down, sum to the budget or a little less.
double scaleToBudget(std::span<const double> priorities, double budget) {
    const double largest = priorities.empty() ? 0.0 : *std::max_element(priorities.begin(), priorities.end());
    if (largest <= 0.0 || budget < 1.0)
        return 0.0;
    const auto splits = [&](double scale) {
        double sum = 0.0;
        for (const double p : priorities)
            sum += std::floor(p * scale);
        return sum;
    };
    double enough = (budget + 1.0) / largest;
    double scale = 0.0;
    for (int i = 0; i < 24; ++i) { // halvings: one part in 16 million
        const double middle = 0.5 * (scale + enough);
        (splits(middle) <= budget ? scale : enough) = middle;
    }
    return scale;
}

} // namespace

std::vector<Fragment> presplit(std::span<const Triangle> triangles, const Bounds& bounds, float budget) {
    const Grid grid(bounds);
    std::vector<double> priorities;
    priorities.reserve(triangles.size());
    for (const Triangle& triangle : triangles)
        priorities.push_back(priority(grid, triangle));
    const double scale =
        scaleToBudget(priorities, std::floor(static_cast<double>(triangles.size()) * budget));
    std::vector<Fragment> fragments;
    fragments.reserve(triangles.size());
    for (uint32_t id = 0; id < triangles.size(); ++id) {
        const Triangle& t = triangles[id];
        const auto splits = static_cast<uint32_t>(priorities[id] * scale);
        if (splits == 0)
            fragments.push_back({id, triangleBox(t)});
        else
            appendPieces(grid, id, {t.v0, t.v1, t.v2}, triangleBox(t), splits, fragments);
    }
    return fragments;
}

} // namespace lavalight
