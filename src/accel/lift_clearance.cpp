#include "accel/lift_clearance.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "accel/z_curve_tree.h"
#include "base/parallel.h"
#include "shared/scene.h"

namespace lavalight {
namespace {

using Corners = std::array<glm::vec3, 3>;

Corners cornersOf(const Triangle& t) {
    return {t.v0, t.v1, t.v2};
}

// A triangle of a smooth mesh with the normals at its corners.
struct SmoothTriangle {
    Corners corners;
    Corners normals;
};

// Triangles by their ids, with the meshes that they come from.
class SmoothTriangles {
  public:
    explicit SmoothTriangles(const Scene& scene) : scene_(scene) {
        uint32_t first = 0;
        for (const Mesh& mesh : scene.meshes) {
            firsts_.push_back(first);
            first += static_cast<uint32_t>(mesh.triangles.size());
        }
    }

    [[nodiscard]] uint32_t meshOf(uint32_t triangle) const {
        return static_cast<uint32_t>(std::ranges::upper_bound(firsts_, triangle) - firsts_.begin()) - 1;
    }
    [[nodiscard]] bool isSmooth(uint32_t triangle) const {
        return !scene_.meshes[meshOf(triangle)].normals.empty();
    }
    [[nodiscard]] SmoothTriangle at(uint32_t triangle) const {
        const uint32_t index = meshOf(triangle);
        const Mesh& mesh = scene_.meshes[index];
        const glm::uvec3 t = mesh.triangles[triangle - firsts_[index]];
        return {{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]},
                {mesh.normals[t.x], mesh.normals[t.y], mesh.normals[t.z]}};
    }

  private:
    const Scene& scene_;
    std::vector<uint32_t> firsts_;
};

// The prism that contains the smooth surface on one side of a triangle: points with dot(normals[i], x -
// origin) <= ends[i]. It is smaller by rounding, so that what only touches it stays outside.
struct LiftPrism {
    glm::vec3 origin;
    std::array<glm::vec3, 5> normals;
    std::array<float, 5> ends;
    float reach = 0.0f; // beyond the triangle, in any direction
};

// rises[k][j]: how far above corner j the plane through corner k lies, along the normal there.
using Rises = std::array<std::array<float, 3>, 3>;

// A bound on a lift's component. The lift at barycentrics b is at most the sum over k and j of b_k b_j
// rises[k][j], and its component that sum with each term times components[k]. Of the three products b_k b_j,
// the sum is at most 1/3.
float largestLift(const Rises& rises, const glm::vec3& components) {
    float largest = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const int j = (k + 1) % 3;
        largest = std::max(largest, rises[k][j] * components[k] + rises[j][k] * components[j]);
    }
    return largest / 3.0f;
}

// normals: at the corners, on the side of ng.
Rises risesOf(const Corners& c, const Corners& normals, const glm::vec3& ng) {
    Rises rises{};
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
            if (glm::dot(normals[k], ng) > kLeastTrustedCosine)
                rises[k][j] = std::max(0.0f, glm::dot(c[k] - c[j], normals[k]));
    return rises;
}

float longestEdge(const Corners& c) {
    return std::max({glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
}

// side: 1 for the front, -1 for the back. None where the smooth surface is the triangle.
std::optional<LiftPrism> liftPrism(const SmoothTriangle& t, float side) {
    const Corners& c = t.corners;
    const glm::vec3 ng = side * glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
    const Corners normals{side * t.normals[0], side * t.normals[1], side * t.normals[2]};
    const Rises rises = risesOf(c, normals, ng);
    const auto liftAlong = [&](const glm::vec3& axis) {
        glm::vec3 components;
        for (int k = 0; k < 3; ++k)
            components[k] = std::max(0.0f, glm::dot(normals[k], axis));
        return largestLift(rises, components);
    };
    const float least = kLeastLift * longestEdge(c);
    const float height = liftAlong(ng);
    if (!(height > least)) // true for triangles without an area
        return std::nullopt;
    LiftPrism prism;
    prism.origin = c[0];
    prism.normals[0] = -ng;
    prism.ends[0] = -least;
    prism.normals[1] = ng;
    prism.ends[1] = height;
    for (int e = 0; e < 3; ++e) {
        const glm::vec3 outwards = side * glm::normalize(glm::cross(c[(e + 1) % 3] - c[e], ng));
        prism.normals[2 + e] = outwards;
        prism.ends[2 + e] = glm::dot(outwards, c[e] - c[0]) + liftAlong(outwards) - least;
    }
    prism.reach = 1.0001f * largestLift(rises, glm::vec3(1.0f));
    return prism;
}

// Corners about the origin of a prism, by component. The fourth is the third again: compilers then take all
// at once.
struct CornerLanes {
    std::array<float, 4> x, y, z;
};

CornerLanes lanesOf(const Corners& corners, const glm::vec3& origin) {
    CornerLanes lanes{};
    for (size_t i = 0; i < 4; ++i) {
        const glm::vec3 corner = corners[std::min<size_t>(i, 2)] - origin;
        lanes.x[i] = corner.x;
        lanes.y[i] = corner.y;
        lanes.z[i] = corner.z;
    }
    return lanes;
}

// Whether all of a triangle lies beyond one of the planes: true of most, for the neighbours lie below the
// prism.
bool isBeyondAPlane(const LiftPrism& prism, const CornerLanes& corners) {
    for (size_t i = 0; i < prism.normals.size(); ++i) {
        const glm::vec3& n = prism.normals[i];
        std::array<float, 4> along;
        for (size_t j = 0; j < 4; ++j)
            along[j] = n.x * corners.x[j] + n.y * corners.y[j] + n.z * corners.z[j];
        if (std::min(std::min(along[0], along[1]), std::min(along[2], along[3])) > prism.ends[i])
            return true;
    }
    return false;
}

// Whether a part of a triangle lies inside: what the prism's planes leave of it, one after the other.
bool overlaps(const LiftPrism& prism, const Corners& corners) {
    std::array<glm::vec3, 8> polygon; // a plane adds one corner at most
    size_t count = 3;
    for (size_t i = 0; i < 3; ++i)
        polygon[i] = corners[i] - prism.origin;
    for (size_t plane = 0; plane < prism.normals.size() && count > 0; ++plane) {
        std::array<glm::vec3, 8> kept;
        size_t keptCount = 0;
        for (size_t i = 0; i < count; ++i) {
            const glm::vec3& a = polygon[i];
            const glm::vec3& b = polygon[(i + 1) % count];
            const float insideA = prism.ends[plane] - glm::dot(prism.normals[plane], a);
            const float insideB = prism.ends[plane] - glm::dot(prism.normals[plane], b);
            if (insideA >= 0.0f)
                kept[keptCount++] = a;
            if ((insideA >= 0.0f) != (insideB >= 0.0f))
                kept[keptCount++] = glm::mix(a, b, insideA / (insideA - insideB));
        }
        polygon = kept;
        count = keptCount;
    }
    return count > 0;
}

bool shareACorner(const Corners& a, const Corners& b) {
    return std::ranges::any_of(a, [&](const glm::vec3& corner) { return std::ranges::count(b, corner) > 0; });
}

// Whether both belong to one smooth surface: they share a corner and the normal there.
bool isContinued(const SmoothTriangle& a, const SmoothTriangle& b) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (a.corners[i] == b.corners[j] && glm::dot(a.normals[i], b.normals[j]) > 0.999f)
                return true;
    return false;
}

// A look around one triangle for what overlaps the prism on either of its sides.
struct Search {
    size_t place; // of the triangle, in the tree
    SmoothTriangle triangle;
    std::array<std::optional<LiftPrism>, 2> prisms;

    [[nodiscard]] bool isFree() const { return !prisms[0] && !prisms[1]; }
    [[nodiscard]] Box box() const {
        const Corners& c = triangle.corners;
        const float reach =
            std::max(prisms[0] ? prisms[0]->reach : 0.0f, prisms[1] ? prisms[1]->reach : 0.0f);
        return {glm::min(glm::min(c[0], c[1]), c[2]) - reach, glm::max(glm::max(c[0], c[1]), c[2]) + reach};
    }
    [[nodiscard]] bool isClear(const Corners& other) const {
        const CornerLanes lanes = lanesOf(other, triangle.corners[0]); // the origin of both prisms
        return (!prisms[0] || isBeyondAPlane(*prisms[0], lanes)) &&
               (!prisms[1] || isBeyondAPlane(*prisms[1], lanes));
    }
    [[nodiscard]] bool isOverlapped(const Corners& other) const {
        return (prisms[0] && overlaps(*prisms[0], other)) || (prisms[1] && overlaps(*prisms[1], other));
    }
};

bool isCrowded(const SmoothTriangles& smooth, const ZCurveTree& tree, const Search& search) {
    bool isCrowded = false;
    tree.visitIn(search.box(), [&](size_t place) {
        if (place == search.place)
            return true;
        const Corners corners = cornersOf(tree.triangles()[place]);
        if (search.isClear(corners))
            return true;
        const uint32_t id = tree.id(place);
        const bool isOneSurface = shareACorner(search.triangle.corners, corners) && smooth.isSmooth(id) &&
                                  isContinued(search.triangle, smooth.at(id));
        isCrowded = !isOneSurface && search.isOverlapped(corners);
        return !isCrowded;
    });
    return isCrowded;
}

} // namespace

std::vector<bool> crowdedLifts(const Scene& scene, std::span<const Triangle> triangles) {
    const SmoothTriangles smooth(scene);
    const auto prismsOf = [](const SmoothTriangle& corners) {
        return std::array{liftPrism(corners, 1.0f), liftPrism(corners, -1.0f)};
    };
    const auto isLifted = [&](uint32_t id) {
        if (!smooth.isSmooth(id))
            return false;
        const auto [front, back] = prismsOf(smooth.at(id));
        return front || back;
    };
    bool isAnyLifted = false;
    for (uint32_t id = 0; id < triangles.size() && !isAnyLifted; ++id)
        isAnyLifted = isLifted(id);
    if (!isAnyLifted)
        return {};
    const ZCurveTree tree(triangles);
    std::vector<uint8_t> crowded(triangles.size()); // bytes, which threads may write side by side
    constexpr size_t kAtATime = 1024;
    forEachInParallel((triangles.size() + kAtATime - 1) / kAtATime, [&](size_t part) {
        const size_t end = std::min(triangles.size(), (part + 1) * kAtATime);
        for (size_t place = part * kAtATime; place < end; ++place) {
            const uint32_t id = tree.id(place);
            if (!smooth.isSmooth(id))
                continue;
            const SmoothTriangle triangle = smooth.at(id);
            const Search search{place, triangle, prismsOf(triangle)};
            crowded[id] = !search.isFree() && isCrowded(smooth, tree, search);
        }
    });
    return {crowded.begin(), crowded.end()};
}

} // namespace lavalight
