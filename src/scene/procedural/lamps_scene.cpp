#include "scene/procedural/lamps_scene.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "scene/procedural/integer_noise.h"
#include "scene/procedural/overview_camera.h"

namespace lavalight {
namespace {

constexpr uint32_t kMostLamps = 1'000'000;
constexpr float kFloorSize = 20.0f;   // metres a side
constexpr float kTotalPower = 800.0f; // W per channel

enum MaterialIndex : uint32_t { kMatt, kLamp };

void addQuad(Mesh& mesh, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : {corner, corner + u, corner + u + v, corner + v})
        mesh.positions.push_back(p);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
}

Mesh makeFloorAndBoxes() {
    Mesh mesh{"floor and boxes", kMatt, {}, {}, {}};
    const float half = 0.5f * kFloorSize;
    addQuad(mesh, {-half, 0, half}, {kFloorSize, 0, 0}, {0, 0, -kFloorSize});
    for (uint32_t i = 0; i < 24; ++i) {
        const glm::vec3 size(0.5f + random(i, 1), 0.5f + 1.5f * random(i, 2), 0.5f + random(i, 3));
        const glm::vec3 low((random(i, 4) - 0.5f) * 0.8f * kFloorSize, 0.0f,
                            (random(i, 5) - 0.5f) * 0.8f * kFloorSize);
        const glm::vec3 x(size.x, 0, 0);
        const glm::vec3 y(0, size.y, 0);
        const glm::vec3 z(0, 0, size.z);
        addQuad(mesh, low + y + z, x, -z); // top, then the four sides
        addQuad(mesh, low + z, x, y);
        addQuad(mesh, low + x, -x, y);
        addQuad(mesh, low, z, y);
        addQuad(mesh, low + x + z, -z, y);
    }
    return mesh;
}

// Equal triangles, facing down, between 2.5 and 4.5 m above the floor.
Mesh makeLamps(uint32_t count, float side) {
    Mesh mesh{"lamps", kLamp, {}, {}, {}};
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 p((random(i, 6) - 0.5f) * kFloorSize, 2.5f + 2.0f * random(i, 7),
                          (random(i, 8) - 0.5f) * kFloorSize);
        const uint32_t first = 3 * i;
        mesh.positions.push_back(p);
        mesh.positions.push_back(p + glm::vec3(side, 0, 0));
        mesh.positions.push_back(p + glm::vec3(0, 0, side));
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

} // namespace

Scene makeLampsScene(uint32_t lampCount) {
    if (lampCount < 1 || lampCount > kMostLamps)
        throw Error(fmt::format("cannot build lamps-{}: 1 to {} lamps are supported", lampCount, kMostLamps));
    const float side = 1.0f / std::sqrt(static_cast<float>(lampCount)); // an area of 1/2 m^2 in all
    const float radiance = kTotalPower / (0.5f * 3.14159265f);
    Scene scene;
    scene.source = "lamps-" + std::to_string(lampCount);
    scene.materials.push_back(
        {.name = "matt", .baseColor = glm::vec3(0.6f), .metallic = 0.0f, .specular = 0.0f});
    scene.materials.push_back({.name = "lamp",
                               .baseColor = glm::vec3(0.0f),
                               .metallic = 0.0f,
                               .emission = glm::vec3(radiance),
                               .specular = 0.0f});
    scene.meshes = {makeFloorAndBoxes(), makeLamps(lampCount, side)};
    scene.cameras.push_back(overviewCamera({0.0f, 6.0f, 15.0f}, 0.4f));
    const float half = 0.5f * kFloorSize;
    scene.bounds = {{-half, 0.0f, -half}, {half + 1.0f, 4.5f, half + 1.0f}};
    return scene;
}

} // namespace lavalight
