// A procedural scene for benchmarks. Only integer hashes, sums, products and square roots: no sine, which
// libraries round differently.
#include "scene/procedural/dense_scene.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/procedural/integer_noise.h"
#include "scene/procedural/overview_camera.h"

namespace lavalight {

namespace {

constexpr float kGroundSize = 20.0f;   // metres a side
constexpr uint32_t kMaterialCount = 4; // matt ones; the panel's comes after them

// Smooth noise in [-1, 1] with a period of one unit.
float noise(glm::vec3 p, uint32_t seed) {
    const glm::vec3 cell = glm::floor(p);
    const glm::vec3 f = p - cell;
    const glm::vec3 w = f * f * (3.0f - 2.0f * f);
    const glm::ivec3 base(cell);
    float sum = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 o(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::uvec3 key(base + o);
        const glm::vec3 weight = glm::mix(1.0f - w, w, glm::vec3(o));
        sum += weight.x * weight.y * weight.z * random(key.x + seed, key.y, key.z);
    }
    return 2.0f * sum - 1.0f;
}

// A point of the unit circle after so many turns, of which whole ones do not count: a square's outline made
// round.
glm::vec2 circle(float turn) {
    const float s = 4.0f * (turn - std::floor(turn));
    const float f = s - std::floor(s);
    const glm::vec2 quarter = glm::normalize(glm::vec2(1.0f - f, f));
    switch (static_cast<int>(s)) {
    case 0:
        return quarter;
    case 1:
        return {-quarter.y, quarter.x};
    case 2:
        return -quarter;
    default:
        return {quarter.y, -quarter.x};
    }
}

// Sets each normal to the average of the adjacent faces' normals, weighted by area.
void addSmoothNormals(Mesh& mesh) {
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 v0 = mesh.positions[t.x];
        const glm::vec3 n = glm::cross(mesh.positions[t.y] - v0, mesh.positions[t.z] - v0);
        for (const uint32_t corner : {t.x, t.y, t.z})
            mesh.normals[corner] += n;
    }
    for (glm::vec3& n : mesh.normals) {
        const float length = glm::length(n);
        n = length > 0.0f ? n / length : glm::vec3(0.0f, 1.0f, 0.0f);
    }
}

float groundHeight(float x, float z) {
    return 0.8f * noise({0.3f * x, 0.0f, 0.3f * z}, 1) + 0.1f * noise({2.0f * x, 0.0f, 2.0f * z}, 2);
}

Mesh makeGround(uint32_t cells) {
    Mesh mesh{"ground", 0, {}, {}, {}};
    const float step = kGroundSize / static_cast<float>(cells);
    for (uint32_t j = 0; j <= cells; ++j)
        for (uint32_t i = 0; i <= cells; ++i) {
            const float x = step * static_cast<float>(i) - 0.5f * kGroundSize;
            const float z = step * static_cast<float>(j) - 0.5f * kGroundSize;
            mesh.positions.emplace_back(x, groundHeight(x, z), z);
        }
    for (uint32_t j = 0; j < cells; ++j)
        for (uint32_t i = 0; i < cells; ++i) {
            const uint32_t a = j * (cells + 1) + i;
            const uint32_t b = a + cells + 1;
            mesh.triangles.emplace_back(a, b, a + 1);
            mesh.triangles.emplace_back(a + 1, b, b + 1);
        }
    addSmoothNormals(mesh);
    return mesh;
}

struct Blob {
    uint32_t seed;
    bool torus;
    uint32_t around, across; // quads along the two parameters
};

// A point on a ring of radius 1 (tori) or on the unit sphere, before dents and placing. u and v in [0, 1).
glm::vec3 blobPoint(const Blob& blob, float u, float v) {
    const glm::vec2 ring = circle(u);
    if (blob.torus) {
        const glm::vec2 tube = circle(v);
        const float r = 1.0f + 0.4f * tube.x;
        return {r * ring.x, 0.4f * tube.y, -r * ring.y};
    }
    const glm::vec2 meridian = circle(0.75f + 0.5f * v); // from the lower pole to the upper
    return {meridian.x * ring.x, meridian.y, -meridian.x * ring.y};
}

glm::vec3 placed(const Blob& blob, glm::vec3 p) {
    const uint32_t s = blob.seed;
    const float size = 0.15f + 0.6f * random(s, 10) * random(s, 11);
    p *= 1.0f + 0.25f * noise(2.5f * p + 7.0f, s);
    const glm::vec2 tilt = circle(random(s, 12));
    p = {p.x, tilt.x * p.y - tilt.y * p.z, tilt.y * p.y + tilt.x * p.z};
    const float x = (random(s, 13) - 0.5f) * 0.9f * kGroundSize;
    const float z = (random(s, 14) - 0.5f) * 0.9f * kGroundSize;
    return size * p + glm::vec3(x, groundHeight(x, z) + size * 3.0f * random(s, 15), z);
}

Mesh makeBlob(const Blob& blob) {
    Mesh mesh{"blob " + std::to_string(blob.seed), 1 + hash(blob.seed) % (kMaterialCount - 1), {}, {}, {}};
    // A torus closes on itself along v too; a sphere has a row more, its poles being rows of coinciding
    // vertices.
    const uint32_t rows = blob.torus ? blob.across : blob.across + 1;
    for (uint32_t j = 0; j < rows; ++j)
        for (uint32_t i = 0; i < blob.around; ++i)
            mesh.positions.push_back(
                placed(blob, blobPoint(blob, static_cast<float>(i) / static_cast<float>(blob.around),
                                       static_cast<float>(j) / static_cast<float>(blob.across))));
    for (uint32_t j = 0; j < blob.across; ++j)
        for (uint32_t i = 0; i < blob.around; ++i) {
            const uint32_t next = (i + 1) % blob.around;
            const uint32_t low = j * blob.around;
            const uint32_t high = (j + 1) % rows * blob.around;
            if (blob.torus || j > 0)
                mesh.triangles.emplace_back(low + i, low + next, high + i);
            if (blob.torus || j + 1 < blob.across)
                mesh.triangles.emplace_back(low + next, high + next, high + i);
        }
    addSmoothNormals(mesh);
    return mesh;
}

Mesh makePanel() {
    Mesh mesh{"panel", kMaterialCount, {}, {}, {}};
    for (const glm::vec2 corner : {glm::vec2(-2, -2), glm::vec2(2, -2), glm::vec2(2, 2), glm::vec2(-2, 2)})
        mesh.positions.emplace_back(corner.x, 6.0f, corner.y);
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}}; // facing down
    return mesh;
}

// Shares `triangles` out among blobs of different fineness; what rounding leaves goes to the next.
void addBlobs(Scene& scene, uint32_t triangles) {
    const uint32_t count = std::clamp(triangles / 500u, 8u, 600u);
    double weightSum = 0.0;
    const auto weight = [](uint32_t i) { return 0.3 + random(i, 20); };
    for (uint32_t i = 0; i < count; ++i)
        weightSum += weight(i);
    double owed = 0.0;
    for (uint32_t i = 0; i < count; ++i) {
        owed += triangles * weight(i) / weightSum;
        const bool torus = random(i, 21) < 0.4f;
        const auto across = static_cast<uint32_t>(std::clamp(std::sqrt(owed / 4.0), 4.0, 500.0));
        // Rows of whole quads: a sphere's caps have half of them.
        const uint32_t band = torus ? across : across - 1;
        const auto around = static_cast<uint32_t>(std::max(owed / (2.0 * band), 4.0));
        scene.meshes.push_back(makeBlob({i, torus, around, across}));
        owed -= static_cast<double>(scene.meshes.back().triangles.size());
    }
}

} // namespace

Scene makeDenseScene(uint32_t triangleCount) {
    constexpr uint32_t kFewest = 5000;
    const uint32_t target = std::max(triangleCount, kFewest);
    Scene scene;
    scene.source = "dense-" + std::to_string(triangleCount);
    scene.environment = glm::vec3(0.3f, 0.35f, 0.4f);
    for (const glm::vec3 color : {glm::vec3(0.6f), glm::vec3(0.7f, 0.3f, 0.2f), glm::vec3(0.2f, 0.5f, 0.6f),
                                  glm::vec3(0.8f, 0.7f, 0.4f)})
        scene.materials.push_back({.name = "matt", .baseColor = color, .metallic = 0.0f, .specular = 0.0f});
    scene.materials.push_back({.name = "panel", .emission = glm::vec3(10.0f)});

    scene.meshes.push_back(makeGround(static_cast<uint32_t>(std::sqrt(0.1 * target))));
    scene.meshes.push_back(makePanel());
    addBlobs(scene, target - static_cast<uint32_t>(scene.triangleCount()));
    scene.cameras.push_back(overviewCamera({0.0f, 5.0f, 13.0f}, 0.35f));

    scene.bounds = {scene.meshes[0].positions[0], scene.meshes[0].positions[0]};
    for (const Mesh& mesh : scene.meshes)
        for (const glm::vec3& p : mesh.positions)
            scene.bounds = {glm::min(scene.bounds.lower, p), glm::max(scene.bounds.upper, p)};
    return scene;
}

} // namespace lavalight
