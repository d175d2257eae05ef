#include "light/texture_mean.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "image/texel.h"

namespace lavalight {
namespace {

// A convex polygon: a triangle, to which each of the four sides of a cell adds a corner at most.
class Polygon {
  public:
    Polygon() = default;
    explicit Polygon(const std::array<glm::dvec2, 3>& triangle) : count_(triangle.size()) {
        std::copy(triangle.begin(), triangle.end(), corners_.begin());
    }

    void add(const glm::dvec2& corner) {
        assert(count_ < corners_.size());
        corners_[count_++] = corner;
    }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] const glm::dvec2& operator[](std::size_t i) const { return corners_[i]; }
    [[nodiscard]] std::span<const glm::dvec2> corners() const { return {corners_.data(), count_}; }

  private:
    std::array<glm::dvec2, 7> corners_{};
    std::size_t count_ = 0;
};

// The part of a polygon where p[axis] is above (side 1) or below (-1) the limit. Sutherland, Hodgman,
// "Reentrant Polygon Clipping", 1974.
Polygon clipped(const Polygon& polygon, glm::length_t axis, double limit, double side) {
    Polygon kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2& a = polygon[i];
        const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
        const double da = side * (a[axis] - limit);
        const double db = side * (b[axis] - limit);
        if (da >= 0.0)
            kept.add(a);
        if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0))
            kept.add(glm::mix(a, b, da / (da - db)));
    }
    return kept;
}

double twiceArea(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

struct Range {
    int64_t first;
    int64_t last;
};

// Cells of unit length that the polygon reaches into.
Range cellsOf(const Polygon& polygon, glm::length_t axis) {
    double low = polygon[0][axis];
    double high = low;
    for (const glm::dvec2& p : polygon.corners()) {
        low = std::min(low, p[axis]);
        high = std::max(high, p[axis]);
    }
    return {static_cast<int64_t>(std::floor(low)),
            std::max(static_cast<int64_t>(std::floor(low)), static_cast<int64_t>(std::ceil(high)) - 1)};
}

// Texels that these cells are made of.
Range texelsOf(const Polygon& polygon, glm::length_t axis, bool isNearest) {
    const Range cells = cellsOf(polygon, axis);
    return {cells.first, cells.last + (isNearest ? 0 : 1)};
}

// Columns or rows of a picture that contain what texels beyond its borders show: all of them where several
// copies of the picture meet.
Range inPicture(const Range& texels, uint32_t size, Wrap wrap) {
    const auto copyOf = [&](int64_t texel) {
        return static_cast<int64_t>(std::floor(static_cast<double>(texel) / size));
    };
    if (wrap != Wrap::clamp && copyOf(texels.first) != copyOf(texels.last))
        return {0, int64_t{size} - 1};
    const auto [first, last] =
        std::minmax({wrapTexel(texels.first, size, wrap), wrapTexel(texels.last, size, wrap)});
    return {first, last};
}

double cellCount(const std::array<glm::dvec2, 3>& corners) {
    const glm::dvec2 size = glm::max(glm::max(corners[0], corners[1]), corners[2]) -
                            glm::min(glm::min(corners[0], corners[1]), corners[2]);
    return (size.x + 1.0) * (size.y + 1.0);
}

} // namespace

TextureMean::TextureMean(const Picture& picture, const Texture& texture) : texture_(texture) {
    Level level{picture.width, picture.height, {}, {}};
    level.texels.reserve(size_t{picture.width} * picture.height);
    for (uint32_t y = 0; y < picture.height; ++y)
        for (uint32_t x = 0; x < picture.width; ++x)
            level.texels.emplace_back(texelOf(picture, x, y, texture.isSrgb));
    countLit(level);
    levels_.push_back(std::move(level));
    while (levels_.back().width > 1 || levels_.back().height > 1)
        levels_.push_back(halved(levels_.back()));
}

void TextureMean::countLit(Level& level) {
    const size_t stride = size_t{level.width} + 1;
    level.lit.assign(stride * (size_t{level.height} + 1), 0);
    for (uint32_t y = 0; y < level.height; ++y) {
        uint32_t inRow = 0;
        for (uint32_t x = 0; x < level.width; ++x) {
            inRow += level.texels[size_t{y} * level.width + x] != glm::vec3(0.0f) ? 1 : 0;
            level.lit[(y + 1) * stride + x + 1] = level.lit[y * stride + x + 1] + inRow;
        }
    }
    if (level.lit.back() == level.texels.size())
        level.lit.clear();
}

TextureMean::Level TextureMean::halved(const Level& level) {
    Level half{(level.width + 1) / 2, (level.height + 1) / 2, {}, {}};
    half.texels.reserve(size_t{half.width} * half.height);
    for (uint32_t y = 0; y < half.height; ++y)
        for (uint32_t x = 0; x < half.width; ++x) {
            glm::vec3 sum(0.0f);
            for (uint32_t i = 0; i < 4; ++i)
                sum += level.texels[size_t{std::min(2 * y + i / 2, level.height - 1)} * level.width +
                                    std::min(2 * x + i % 2, level.width - 1)];
            half.texels.push_back(0.25f * sum);
        }
    countLit(half);
    return half;
}

// Bilinear textures are shifted by half a texel, so that cells of unit length lie between texel centres.
TextureMean::Triangle TextureMean::onLevel(const std::array<glm::vec2, 3>& uvs, const Level& level) const {
    Triangle triangle;
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 uv(uvs[i], 1.0);
        glm::dvec2& corner = triangle.corners[i];
        corner = {glm::dot(glm::dvec3(texture_.uRow), uv) * level.width,
                  glm::dot(glm::dvec3(texture_.vRow), uv) * level.height};
        if (!texture_.isNearest)
            corner -= 0.5;
        // Numbers of texels stay within 64 bits.
        constexpr double kFarthest = 1e15;
        if (!(glm::length(corner) <= kFarthest))
            corner = glm::dvec2(0.0);
    }
    return triangle;
}

glm::dvec3 TextureMean::texel(const Level& level, int64_t x, int64_t y) const {
    return level.texels[size_t{wrapTexel(y, level.height, texture_.wrapV)} * level.width +
                        wrapTexel(x, level.width, texture_.wrapU)];
}

TextureMean::Cell TextureMean::cellAt(const Level& level, int64_t x, int64_t y) const {
    const glm::dvec2 low(x, y);
    if (texture_.isNearest)
        return {low, {texel(level, x, y)}};
    return {low,
            {texel(level, x, y), texel(level, x + 1, y), texel(level, x, y + 1), texel(level, x + 1, y + 1)}};
}

// Whether all texels that a triangle's cells are made of are black.
bool TextureMean::isBlackUnder(const Triangle& triangle, const Level& level) const {
    if (level.lit.empty())
        return false;
    const Polygon polygon(triangle.corners);
    const Range columns = inPicture(texelsOf(polygon, 0, texture_.isNearest), level.width, texture_.wrapU);
    const Range rows = inPicture(texelsOf(polygon, 1, texture_.isNearest), level.height, texture_.wrapV);
    const auto litBefore = [&](int64_t x, int64_t y) {
        return level.lit[static_cast<size_t>(y) * (size_t{level.width} + 1) + static_cast<size_t>(x)];
    };
    const int64_t right = columns.last + 1;
    const int64_t bottom = rows.last + 1;
    return litBefore(right, bottom) - litBefore(columns.first, bottom) ==
           litBefore(right, rows.first) - litBefore(columns.first, rows.first);
}

// The texture at p, as the cell continues it.
glm::dvec3 TextureMean::filtered(const Cell& cell, const glm::dvec2& p) const {
    const auto& [low, texels] = cell;
    if (texture_.isNearest)
        return texels[0];
    const glm::dvec2 f = p - low;
    return glm::mix(glm::mix(texels[0], texels[1], f.x), glm::mix(texels[2], texels[3], f.x), f.y);
}

// The mean, cell by cell: in each the texture is a polynomial of degree 2, which the midpoints of a
// triangle's edges integrate exactly.
glm::dvec3 TextureMean::meanOver(const Triangle& triangle, const Level& level) const {
    glm::dvec3 sum(0.0);
    double area = 0.0;
    const Polygon whole(triangle.corners);
    const Range rows = cellsOf(whole, 1);
    for (int64_t y = rows.first; y <= rows.last; ++y) {
        const auto top = static_cast<double>(y);
        const Polygon row = clipped(clipped(whole, 1, top, 1.0), 1, top + 1.0, -1.0);
        const Range columns = row.size() == 0 ? Range{0, -1} : cellsOf(row, 0);
        for (int64_t x = columns.first; x <= columns.last; ++x) {
            const auto left = static_cast<double>(x);
            const Polygon part = clipped(clipped(row, 0, left, 1.0), 0, left + 1.0, -1.0);
            const Cell cell = cellAt(level, x, y);
            const bool isBlack = cell.texels == Texels{}; // as most of most emission textures is
            for (size_t i = 2; i < part.size(); ++i) {
                const double weight = twiceArea(part[0], part[i - 1], part[i]);
                area += weight;
                if (!isBlack)
                    sum += weight / 3.0 *
                           (filtered(cell, 0.5 * (part[0] + part[i - 1])) +
                            filtered(cell, 0.5 * (part[i - 1] + part[i])) +
                            filtered(cell, 0.5 * (part[i] + part[0])));
            }
        }
    }
    return area > 0.0 ? sum / area : meanAlong(triangle, level);
}

// The mean over a triangle that is a line or a point in the picture, from points along its edges.
glm::dvec3 TextureMean::meanAlong(const Triangle& triangle, const Level& level) const {
    constexpr int kSteps = 64;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kSteps; ++i)
        for (size_t edge = 0; edge < 3; ++edge) {
            const glm::dvec2 p =
                glm::mix(triangle.corners[edge], triangle.corners[(edge + 1) % 3], (i + 0.5) / kSteps);
            sum += filtered(
                cellAt(level, static_cast<int64_t>(std::floor(p.x)), static_cast<int64_t>(std::floor(p.y))),
                p);
        }
    return sum / (3.0 * kSteps);
}

glm::dvec3 TextureMean::over(const std::array<glm::vec2, 3>& uvs) const {
    for (const Level& level : levels_) {
        const Triangle triangle = onLevel(uvs, level);
        const glm::dvec2 a = triangle.corners[0];
        if (!(cellCount(triangle.corners) <= kMostCells))
            continue;
        if (isBlackUnder(triangle, level))
            return glm::dvec3(0.0);
        // Corners so close together, in texels, that cells of unit length would round away: a point.
        constexpr double kLeastTwiceArea = 1e-9;
        return twiceArea(a, triangle.corners[1], triangle.corners[2]) > kLeastTwiceArea
                   ? meanOver(triangle, level)
                   : meanAlong(triangle, level);
    }
    return levels_.back().texels.front(); // the whole picture, many times
}

} // namespace lavalight
