#include "scene/ground.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lavalight {
namespace {

constexpr float kBelow = 0x1p-13f;    // of the radius: below what is seen, above the rounding of coordinates
constexpr float kInnermost = 2.0f;    // half the side of the square in the middle, in radii
constexpr float kGrowth = 4.0f;       // of the squares
constexpr uint32_t kRings = 6;        // 2 * 4^6 = 8,192 radii
constexpr float kLeastRadius = 1e-3f; // metres: the radius of a scene that has none

// Squares around each other, with four trapezoids between one and the next. Points of a triangle are computed
// as precisely as it is small: one huge square would lift the rays that start below the model by its
// rounding.
//
//   +-------+
//   |\     /|
//   | +---+ |
//   | | + | |
//   | +---+ |
//   |/     \|
//   +-------+
Mesh squares(const glm::vec3& middle, float radius, uint32_t material) {
    constexpr std::array<glm::vec2, 4> kCorners{
        {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}}; // x and z; up is the front
    Mesh mesh;
    mesh.name = "ground";
    mesh.material = material;
    float half = kInnermost * radius;
    for (uint32_t ring = 0; ring <= kRings; ++ring) {
        for (const glm::vec2& corner : kCorners)
            mesh.positions.push_back(middle + half * glm::vec3(corner.x, 0.0f, corner.y));
        half *= kGrowth;
    }
    const auto addQuad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
        mesh.triangles.emplace_back(a, b, c);
        mesh.triangles.emplace_back(a, c, d);
    };
    addQuad(0, 1, 2, 3);
    for (uint32_t inner = 0; inner < 4 * kRings; inner += 4)
        for (uint32_t side = 0; side < 4; ++side) {
            const uint32_t next = (side + 1) % 4;
            addQuad(inner + 4 + side, inner + 4 + next, inner + next, inner + side);
        }
    return mesh;
}

// An object that no mesh is part of. Scenes that are built in name none.
uint32_t freeObject(const Scene& scene) {
    auto object = static_cast<uint32_t>(scene.objects.size());
    for (const Mesh& mesh : scene.meshes)
        object = std::max(object, mesh.object + 1);
    return object;
}

float radiusOf(const Bounds& bounds) {
    return std::max(bounds.radius(), kLeastRadius);
}

} // namespace

float groundHeight(const Bounds& bounds) {
    return bounds.lower.y - kBelow * radiusOf(bounds);
}

void addGround(Scene& scene, float height, const glm::vec3& albedo) {
    const auto material = static_cast<uint32_t>(scene.materials.size());
    scene.materials.push_back({.name = "ground", .baseColor = albedo, .metallic = 0.0f, .specular = 0.0f});
    const uint32_t object = freeObject(scene);
    if (object == scene.objects.size())
        scene.objects.emplace_back("ground");
    const glm::vec3 center = scene.bounds.center();
    const glm::vec3 middle(center.x, height, center.z);
    scene.meshes.push_back(squares(middle, radiusOf(scene.bounds), material));
    scene.meshes.back().object = object;
    for (const glm::vec3& p : scene.meshes.back().positions)
        scene.reach = std::max(scene.reach, glm::distance(p, center));
}

void copyGround(const Scene& from, Scene& to) {
    Mesh& ground = to.meshes.emplace_back(from.meshes.back());
    for (glm::vec3& position : ground.positions)
        position += glm::vec3(from.origin - to.origin);
}

} // namespace lavalight
