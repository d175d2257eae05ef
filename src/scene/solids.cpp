#include "scene/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "scene/coverage.h"

namespace lavalight {
namespace {

// What a body is filled with.
using Medium = std::tuple<float, float, float, float, float, float>;

Medium mediumOf(const Material& m) {
    return {m.ior,
            m.dispersion,
            m.attenuationDistance,
            m.attenuationColor.r,
            m.attenuationColor.g,
            m.attenuationColor.b};
}

// Gives equal numbers to positions that coincide.
class Welder {
  public:
    // tolerance: metres within which positions coincide; 0: they are equal.
    explicit Welder(double tolerance) : tolerance_(tolerance) {}

    uint32_t numberOf(const glm::vec3& p) {
        if (tolerance_ <= 0.0)
            return insert(Cell{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}, p); // -0 is 0
        const glm::dvec3 at = glm::dvec3(p) / (2.0 * tolerance_);
        const glm::dvec3 nearest =
            glm::floor(at + 0.5); // cells around that corner hold all that may coincide
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 cell =
                nearest - glm::dvec3(corner & 1 ? 1 : 0, corner & 2 ? 1 : 0, corner & 4 ? 1 : 0);
            const auto [first, last] = numbers_.equal_range(Cell{cell.x, cell.y, cell.z});
            for (auto found = first; found != last; ++found)
                if (glm::distance(glm::dvec3(found->second.position), glm::dvec3(p)) <= tolerance_)
                    return found->second.number;
        }
        const glm::dvec3 own = glm::floor(at);
        return insert(Cell{own.x, own.y, own.z}, p, false);
    }

  private:
    using Cell = std::array<double, 3>;
    struct Hash {
        size_t operator()(const Cell& cell) const {
            size_t hash = 0;
            for (const double x : cell)
                hash = (hash ^ std::hash<double>()(x)) * 0x9e3779b97f4a7c15u;
            return hash ^ hash >> 32u;
        }
    };
    struct Welded {
        uint32_t number;
        glm::vec3 position;
    };

    uint32_t insert(const Cell& cell, const glm::vec3& p, bool looks = true) {
        if (looks)
            if (const auto found = numbers_.find(cell); found != numbers_.end())
                return found->second.number;
        numbers_.emplace(cell, Welded{count_, p});
        return count_++;
    }

    double tolerance_;
    uint32_t count_ = 0;
    std::unordered_multimap<Cell, Welded, Hash> numbers_;
};

// A use of an edge by a mesh: +1 where a triangle runs along it from the lower to the higher vertex.
struct EdgeUse {
    uint64_t edge;
    uint32_t mesh;
    int32_t direction;
};

void addEdges(const Mesh& mesh, uint32_t index, Welder& welder, std::vector<EdgeUse>& uses) {
    std::vector<uint32_t> welded;
    welded.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions)
        welded.push_back(welder.numberOf(position));
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            const uint64_t a = welded[triangle[i]];
            const uint64_t b = welded[triangle[(i + 1) % 3]];
            if (a != b)
                uses.push_back({std::min(a, b) << 32u | std::max(a, b), index, a < b ? 1 : -1});
        }
}

// Sets of meshes that are closed together.
class MeshGroups {
  public:
    explicit MeshGroups(size_t meshes) : parents_(meshes), isOpen_(meshes, false) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }
    uint32_t groupOf(uint32_t mesh) {
        while (parents_[mesh] != mesh)
            mesh = parents_[mesh] = parents_[parents_[mesh]];
        return mesh;
    }
    void join(uint32_t a, uint32_t b) {
        const uint32_t first = std::min(groupOf(a), groupOf(b));
        const uint32_t second = std::max(groupOf(a), groupOf(b));
        parents_[second] = first;
        isOpen_[first] = isOpen_[first] || isOpen_[second];
    }
    void open(uint32_t mesh) { isOpen_[groupOf(mesh)] = true; }
    bool isOpen(uint32_t mesh) { return isOpen_[groupOf(mesh)]; }

  private:
    std::vector<uint32_t> parents_;
    std::vector<bool> isOpen_;
};

// Joins meshes that share edges which are open in each, and opens those with edges that stay so. Surfaces on
// whose edges all triangles cancel out are the boundary of something.
void balance(std::vector<EdgeUse>& uses, MeshGroups& groups) {
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.edge, a.mesh) < std::tie(b.edge, b.mesh);
    });
    for (auto use = uses.begin(); use != uses.end();) {
        const uint64_t edge = use->edge;
        int32_t total = 0;
        std::vector<uint32_t> unbalanced;
        while (use != uses.end() && use->edge == edge) {
            const uint32_t mesh = use->mesh;
            int32_t sum = 0;
            for (; use != uses.end() && use->edge == edge && use->mesh == mesh; ++use)
                sum += use->direction;
            total += sum;
            if (sum != 0)
                unbalanced.push_back(mesh);
        }
        for (size_t i = 1; i < unbalanced.size(); ++i)
            groups.join(unbalanced[0], unbalanced[i]);
        if (total != 0)
            groups.open(unbalanced[0]);
    }
}

void include(const Mesh& mesh, Bounds& bounds) {
    for (const glm::vec3& position : mesh.positions) {
        bounds.lower = glm::min(bounds.lower, position);
        bounds.upper = glm::max(bounds.upper, position);
    }
}

double volumeOf(const Bounds& bounds) {
    const glm::dvec3 extent = glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower);
    return extent.x * extent.y * extent.z;
}

// Six times what the surface encloses; below 0 if the fronts are inside.
double signedVolume(const Mesh& mesh, const glm::dvec3& reference) {
    double sum = 0.0;
    for (const glm::uvec3& t : mesh.triangles)
        sum += glm::dot(glm::dvec3(mesh.positions[t.x]) - reference,
                        glm::cross(glm::dvec3(mesh.positions[t.y]) - reference,
                                   glm::dvec3(mesh.positions[t.z]) - reference));
    return sum;
}

// Meshes that light enters, by what lies behind their fronts.
std::map<Medium, std::vector<uint32_t>> solidMeshes(const Scene& scene) {
    std::map<Medium, std::vector<uint32_t>> meshes;
    for (uint32_t i = 0; i < scene.meshes.size(); ++i)
        if (const Material& material = scene.materials[scene.meshes[i].material];
            boundsSolid(material) && !scene.meshes[i].positions.empty())
            meshes[mediumOf(material)].push_back(i);
    return meshes;
}

MeshGroups groupsOf(const Scene& scene, const std::vector<uint32_t>& meshes, double tolerance) {
    MeshGroups groups(scene.meshes.size());
    Welder welder(tolerance);
    std::vector<EdgeUse> uses;
    for (const uint32_t mesh : meshes)
        addEdges(scene.meshes[mesh], mesh, welder, uses);
    balance(uses, groups);
    return groups;
}

// Distance between vertices that were meant to be one: a few roundings of their coordinates.
double weldDistance(const Scene& scene, const std::vector<uint32_t>& meshes) {
    glm::vec3 largest(0.0f);
    for (const uint32_t mesh : meshes)
        for (const glm::vec3& position : scene.meshes[mesh].positions)
            largest = glm::max(largest, glm::abs(position));
    return 1e-6 * std::max({largest.x, largest.y, largest.z});
}

struct Body {
    std::vector<uint32_t> meshes;
    Bounds bounds;
};

// Bodies among the meshes, which have one medium; meshes that bound none go to `open`.
std::vector<Body> bodiesOf(const Scene& scene, const std::vector<uint32_t>& meshes, double tolerance,
                           std::vector<uint32_t>& open) {
    MeshGroups groups = groupsOf(scene, meshes, tolerance);
    std::map<uint32_t, Body> bodies;
    for (const uint32_t mesh : meshes) {
        if (groups.isOpen(mesh)) {
            open.push_back(mesh);
            continue;
        }
        const glm::vec3& first = scene.meshes[mesh].positions.front();
        Body& body = bodies.try_emplace(groups.groupOf(mesh), Body{{}, {first, first}}).first->second;
        body.meshes.push_back(mesh);
        include(scene.meshes[mesh], body.bounds);
    }
    std::vector<Body> list;
    for (auto& [group, body] : bodies) {
        double volume = 0.0;
        for (const uint32_t mesh : body.meshes)
            volume += signedVolume(scene.meshes[mesh], glm::dvec3(body.bounds.center()));
        if (volume > 0.0)
            list.push_back(std::move(body));
        else
            open.insert(open.end(), body.meshes.begin(), body.meshes.end());
    }
    return list;
}

// Meshes through which alpha lets rays pass are no boundaries.
void dropTransparent(const Scene& scene, std::vector<uint32_t>& meshes, std::vector<uint32_t>& open) {
    const auto mayPass = [&](uint32_t mesh) {
        return scene.materials[scene.meshes[mesh].material].alphaMode != AlphaMode::opaque;
    };
    if (std::none_of(meshes.begin(), meshes.end(), mayPass))
        return;
    const std::vector<bool> transparent = transparentMeshes(scene);
    for (const uint32_t mesh : meshes)
        if (transparent[mesh])
            open.push_back(mesh);
    std::erase_if(meshes, [&](uint32_t mesh) { return transparent[mesh]; });
}

} // namespace

bool boundsSolid(const Material& material) {
    return material.isSolid && (material.transmission > 0.0f || material.diffuseTransmission > 0.0f);
}

void findSolids(Scene& scene) {
    std::vector<Body> bodies;
    std::vector<uint32_t> open;
    for (auto& [medium, meshes] : solidMeshes(scene)) {
        dropTransparent(scene, meshes, open);
        std::vector<uint32_t> loose;
        std::vector<Body> closed = bodiesOf(scene, meshes, 0.0, loose);
        bodies.insert(bodies.end(), closed.begin(), closed.end());
        closed = bodiesOf(scene, loose, weldDistance(scene, loose), open);
        bodies.insert(bodies.end(), closed.begin(), closed.end());
    }
    std::sort(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) {
        return std::pair(volumeOf(a.bounds), a.meshes.front()) <
               std::pair(volumeOf(b.bounds), b.meshes.front());
    });
    scene.solids.clear();
    scene.openSolids.clear();
    for (Mesh& mesh : scene.meshes)
        mesh.solid = 0;
    for (const Body& body : bodies) {
        scene.solids.push_back({body.meshes.front(), body.bounds});
        for (const uint32_t mesh : body.meshes)
            scene.meshes[mesh].solid = static_cast<uint32_t>(scene.solids.size());
    }
    std::sort(open.begin(), open.end());
    for (const uint32_t mesh : open)
        scene.openSolids.push_back(scene.meshes[mesh].name);
    scene.openSolids.erase(std::unique(scene.openSolids.begin(), scene.openSolids.end()),
                           scene.openSolids.end());
}

namespace {

// Solid angle under which a point sees a triangle, positive from behind its front. Based on: van Oosterom and
// Strackee, "The Solid Angle of a Plane Triangle", 1983.
double solidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), denominator);
}

// Whether the origin lies on the triangle, or so near that rounding may take it to the other side.
bool isOn(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    constexpr double kNear = 1e-5; // of the triangle's size
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = glm::length(normal);
    if (std::abs(glm::dot(normal, a)) > kNear * area * std::sqrt(area))
        return false;
    const double most = -kNear * area * area;
    return glm::dot(normal, glm::cross(b, c)) >= most && glm::dot(normal, glm::cross(c, a)) >= most &&
           glm::dot(normal, glm::cross(a, b)) >= most;
}

bool isWithin(const Bounds& bounds, const glm::dvec3& point) {
    return glm::all(glm::greaterThanEqual(point, glm::dvec3(bounds.lower))) &&
           glm::all(glm::lessThanEqual(point, glm::dvec3(bounds.upper)));
}

} // namespace

SolidsAround solidsAround(const Scene& scene, const glm::dvec3& point) {
    SolidsAround around;
    std::vector<double> angles(scene.solids.size(), 0.0);
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.solid == 0 || !isWithin(scene.solids[mesh.solid - 1].bounds, point))
            continue;
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::dvec3 a = glm::dvec3(mesh.positions[t.x]) - point;
            const glm::dvec3 b = glm::dvec3(mesh.positions[t.y]) - point;
            const glm::dvec3 c = glm::dvec3(mesh.positions[t.z]) - point;
            angles[mesh.solid - 1] += solidAngle(a, b, c);
            around.isOnSurface |= isOn(a, b, c);
        }
    }
    for (size_t i = 0; i < angles.size(); ++i) {
        const long turns = std::lround(angles[i] / (4.0 * std::numbers::pi));
        for (long turn = 0; turn < turns; ++turn)
            around.numbers.push_back(static_cast<uint32_t>(i + 1));
    }
    return around;
}

} // namespace lavalight
