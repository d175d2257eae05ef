#include "light/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lavalight {
namespace {

using std::numbers::pi;

// Masses of one level, row by row.
struct Level {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<double> masses;

    // Nothing lies beyond the right and the lower border.
    [[nodiscard]] double at(uint32_t x, uint32_t y) const {
        return x < width && y < height ? masses[size_t{y} * width + x] : 0.0;
    }
};

// Solid angle of a cell in that row, sr.
double solidAngle(const Image& map, uint32_t row) {
    const double top = pi * std::max(row - 0.5, 0.0) / map.height;
    const double bottom = pi * std::min(row + 0.5, static_cast<double>(map.height)) / map.height;
    return 4.0 * pi / map.width * std::sin(0.5 * (top + bottom)) * std::sin(0.5 * (bottom - top));
}

// Mean radiance of the cell's four corners.
glm::dvec3 meanOfCell(const Image& map, uint32_t x, uint32_t y) {
    const uint32_t left = (x == 0 ? map.width : x) - 1;
    const uint32_t above = std::max(y, 1u) - 1;
    const uint32_t below = std::min(y, map.height - 1);
    return 0.25 * (glm::dvec3(map.at(left, above)) + glm::dvec3(map.at(x, above)) +
                   glm::dvec3(map.at(left, below)) + glm::dvec3(map.at(x, below)));
}

Level halved(const Level& level) {
    Level half{(level.width + 1) / 2, (level.height + 1) / 2, {}};
    half.masses.reserve(size_t{half.width} * half.height);
    for (uint32_t y = 0; y < half.height; ++y)
        for (uint32_t x = 0; x < half.width; ++x)
            half.masses.push_back(level.at(2 * x, 2 * y) + level.at(2 * x + 1, 2 * y) +
                                  level.at(2 * x, 2 * y + 1) + level.at(2 * x + 1, 2 * y + 1));
    return half;
}

// Probability of the first of two. Random numbers are multiples of 2^-24: what has mass stays within their
// reach.
float firstOfTwo(double first, double second) {
    constexpr float kStep = 0x1p-24f;
    if (!(first > 0.0) || !(second > 0.0))
        return second > 0.0 ? 0.0f : 1.0f;
    return std::clamp(static_cast<float>(first / (first + second)), kStep, 1.0f - kStep);
}

// Appends the quads over `children`. `pmfs` are the probabilities of these quads, and of the children after
// it.
void appendQuads(const Level& children, std::vector<EnvironmentQuad>& quads, std::vector<double>& pmfs) {
    std::vector<double> childPmfs(children.masses.size());
    const auto give = [&](uint32_t x, uint32_t y, double pmf) {
        if (x < children.width && y < children.height)
            childPmfs[size_t{y} * children.width + x] = pmf;
    };
    const uint32_t width = (children.width + 1) / 2;
    for (size_t i = 0; i < pmfs.size(); ++i) {
        const auto x = static_cast<uint32_t>(2 * (i % width));
        const auto y = static_cast<uint32_t>(2 * (i / width));
        const double topLeft = children.at(x, y);
        const double topRight = children.at(x + 1, y);
        const double bottomLeft = children.at(x, y + 1);
        const double bottomRight = children.at(x + 1, y + 1);
        const EnvironmentQuad quad{firstOfTwo(topLeft + topRight, bottomLeft + bottomRight),
                                   firstOfTwo(topLeft, topRight), firstOfTwo(bottomLeft, bottomRight)};
        const double top = pmfs[i] * quad.top;
        const double bottom = pmfs[i] * (1.0 - quad.top);
        give(x, y, top * quad.leftOfTop);
        give(x + 1, y, top * (1.0 - quad.leftOfTop));
        give(x, y + 1, bottom * quad.leftOfBottom);
        give(x + 1, y + 1, bottom * (1.0 - quad.leftOfBottom));
        quads.push_back(quad);
    }
    pmfs = std::move(childPmfs);
}

} // namespace

EnvironmentDistribution makeEnvironmentDistribution(const Image& map) {
    EnvironmentDistribution distribution;
    distribution.width = map.width;
    distribution.height = map.height;
    std::vector<Level> levels{{map.width, map.height + 1, {}}};
    levels[0].masses.reserve(size_t{map.width} * (map.height + 1));
    for (uint32_t y = 0; y <= map.height; ++y) {
        const double angle = solidAngle(map, y);
        for (uint32_t x = 0; x < map.width; ++x) {
            const glm::dvec3 power = angle * meanOfCell(map, x, y);
            distribution.meanRadiance += power / (4.0 * pi);
            levels[0].masses.push_back(power.x + power.y + power.z);
        }
    }
    while (levels.back().masses.size() > 1)
        levels.push_back(halved(levels.back()));

    std::vector<double> pmfs{1.0};
    for (size_t level = levels.size() - 1; level-- > 0;)
        appendQuads(levels[level], distribution.quads, pmfs);
    distribution.quads.front().levels = static_cast<float>(levels.size() - 1);
    distribution.scales.reserve(pmfs.size());
    for (size_t i = 0; i < pmfs.size(); ++i) {
        const double mass = levels[0].masses[i];
        distribution.scales.push_back(mass > 0.0 ? static_cast<float>(pmfs[i] / mass) : 0.0f);
    }
    return distribution;
}

} // namespace lavalight
