#include "support/closed_meshes.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "support/random_numbers.h"

namespace lavalight::test {
namespace {

// Index of the point between two vertices on the unit sphere, made once for both triangles of the edge.
class Midpoints {
  public:
    explicit Midpoints(std::vector<glm::vec3>& positions) : positions_(&positions) {}
    uint32_t between(uint32_t a, uint32_t b) {
        const auto [found, isNew] = indices_.try_emplace(std::pair(std::min(a, b), std::max(a, b)),
                                                         static_cast<uint32_t>(positions_->size()));
        if (isNew)
            positions_->push_back(glm::normalize((*positions_)[a] + (*positions_)[b]));
        return found->second;
    }

  private:
    std::vector<glm::vec3>* positions_; // outlives this
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> indices_;
};

ClosedMesh makeIcosahedron() {
    const float g = std::numbers::phi_v<float>;
    ClosedMesh mesh;
    mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (glm::vec3& p : mesh.positions)
        p = glm::normalize(p);
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    return mesh;
}

} // namespace

ClosedMesh makeCube() {
    ClosedMesh mesh;
    for (uint32_t i = 0; i < 8; ++i) // bits: x, y, z
        mesh.positions.emplace_back(i & 1u ? 1.0f : -1.0f, i & 2u ? 1.0f : -1.0f, i & 4u ? 1.0f : -1.0f);
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

ClosedMesh makeGriddedCube(uint32_t cells) {
    std::vector<glm::vec3> positions;
    std::map<std::array<uint32_t, 3>, uint32_t> indices;
    const auto vertex = [&](const std::array<uint32_t, 3>& place) {
        const auto [found, isNew] = indices.try_emplace(place, static_cast<uint32_t>(positions.size()));
        if (isNew)
            positions.push_back(2.0f * glm::vec3(place[0], place[1], place[2]) / static_cast<float>(cells) -
                                1.0f);
        return found->second;
    };
    std::vector<glm::uvec3> triangles;
    for (uint32_t face = 0; face < 6; ++face)
        for (uint32_t cell = 0; cell < cells * cells; ++cell) {
            const bool isUpper = face >= 3;
            const auto corner = [&](uint32_t u, uint32_t v) {
                std::array<uint32_t, 3> place{};
                place[face % 3] = isUpper ? cells : 0;
                place[(face + 1) % 3] =
                    cell % cells + (isUpper ? u : v); // swapped below: fronts face outward
                place[(face + 2) % 3] = cell / cells + (isUpper ? v : u);
                return vertex(place);
            };
            const uint32_t a = corner(0, 0);
            const uint32_t b = corner(1, 0);
            const uint32_t c = corner(1, 1);
            const uint32_t d = corner(0, 1);
            triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        }
    return {std::move(positions), std::move(triangles)};
}

ClosedMesh makeIcosphere(uint32_t subdivisions) {
    ClosedMesh mesh = makeIcosahedron();
    for (uint32_t i = 0; i < subdivisions; ++i) {
        Midpoints midpoints(mesh.positions);
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& t : mesh.triangles) {
            const uint32_t xy = midpoints.between(t.x, t.y);
            const uint32_t yz = midpoints.between(t.y, t.z);
            const uint32_t zx = midpoints.between(t.z, t.x);
            finer.insert(finer.end(), {{t.x, xy, zx}, {t.y, yz, xy}, {t.z, zx, yz}, {xy, yz, zx}});
        }
        mesh.triangles = std::move(finer);
    }
    return mesh;
}

ClosedMesh displaced(ClosedMesh mesh, float amount, uint32_t seed) {
    Random random(seed);
    for (glm::vec3& p : mesh.positions)
        p *= 1.0f + random.between(-amount, amount);
    return mesh;
}

glm::vec3 Placement::centre() const {
    return scale * distance * glm::normalize(glm::vec3(1.0f, -0.7f, 0.4f));
}

std::string Placement::name() const {
    return fmt::format("of size {}, {} sizes from the origin", scale, distance);
}

ClosedMesh placed(ClosedMesh mesh, const Placement& placement) {
    for (glm::vec3& p : mesh.positions)
        p = placement.scale * p + placement.centre();
    return mesh;
}

Scene sceneOf(const ClosedMesh& mesh) {
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back({"mesh", 0, mesh.positions, {}, mesh.triangles});
    return scene;
}

} // namespace lavalight::test
