#include "inspect/ray_sets.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <random>

#include "light/alias_table.h"
#include "light/emitters.h"
#include "render/renderer.h"

namespace lavalight {
namespace {

// The standard leaves its distributions open; this is the same everywhere.
class Random {
  public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    [[nodiscard]] uint32_t bits() { return engine_(); }
    [[nodiscard]] float unit() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }

  private:
    std::mt19937 engine_;
};

// By the cosine around `n`: a uniform point on the sphere that touches the surface (tangent to the plane at
// the origin).
glm::vec3 cosineDirection(const glm::vec3& n, Random& random) {
    const float z = 1.0f - 2.0f * random.unit();
    const float phi = 2.0f * std::numbers::pi_v<float> * random.unit();
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const glm::vec3 sum = n + glm::vec3(r * std::cos(phi), r * std::sin(phi), z);
    const float length = glm::length(sum);
    return length > 1e-3f ? sum / length : n; // the antipode: rounding would decide the direction
}

// Square root warp, with the corners' weights in any order.
glm::vec3 pointOn(const Triangle& triangle, Random& random) {
    const float root = std::sqrt(random.unit());
    const float along = random.unit();
    return (1.0f - root) * triangle.v0 + root * (1.0f - along) * triangle.v1 + root * along * triangle.v2;
}

std::vector<AliasEntry> tableByPower(const Emitters& emitters) {
    std::vector<double> powers;
    for (const Emitter& emitter : emitters.list)
        powers.push_back(emitter.power);
    return buildAliasTable(powers);
}

size_t pickFrom(std::span<const AliasEntry> table, Random& random) {
    const auto column = static_cast<size_t>(uint64_t{random.bits()} * table.size() >> 32);
    return random.unit() < table[column].probability ? column : table[column].alias;
}

} // namespace

std::vector<Ray> makeCameraRays(const Camera& camera, size_t count, uint32_t seed) {
    RenderSettings settings;
    const float aspect = camera.aspect.value_or(16.0f / 9.0f);
    settings.image.height =
        std::max(1u, static_cast<uint32_t>(std::sqrt(static_cast<float>(count) / aspect)));
    settings.image.width = std::max(1u, static_cast<uint32_t>(count / settings.image.height));
    const FrameParameters frame = makeFrame(Scene{}, camera, settings);
    Random random(seed);
    std::vector<Ray> rays;
    rays.reserve(size_t{settings.image.width} * settings.image.height);
    for (uint32_t y = 0; y < settings.image.height; ++y)
        for (uint32_t x = 0; x < settings.image.width; ++x) {
            const float down = random.unit(); // apart: arguments are evaluated in any order
            const float across = random.unit();
            const glm::vec2 position(static_cast<float>(x) + across, static_cast<float>(y) + down);
            const glm::vec2 ndc =
                2.0f * position / glm::vec2(settings.image.width, settings.image.height) - 1.0f;
            const glm::vec3 onPlane = ndc.x * frame.cameraRight - ndc.y * frame.cameraUp;
            if (frame.projection == kProjectionOrthographic)
                rays.push_back(freeRay(frame.cameraPosition + onPlane, frame.cameraForward));
            else
                rays.push_back(freeRay(frame.cameraPosition, glm::normalize(frame.cameraForward + onPlane)));
        }
    return rays;
}

std::vector<SurfacePoint> hitPoints(std::span<const Ray> rays, std::span<const TracedHit> hits,
                                    std::span<const Triangle> triangles) {
    assert(rays.size() == hits.size());
    std::vector<SurfacePoint> points;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (!isSurface(hits[i].surface))
            continue;
        const Triangle& triangle = triangles[hits[i].surface.primitive];
        const glm::vec3 normal = glm::cross(triangle.v1 - triangle.v0, triangle.v2 - triangle.v0);
        const float length = glm::length(normal);
        if (!(length > 0.0f))
            continue;
        const bool isFront = glm::dot(normal, rays[i].direction) < 0.0f;
        const glm::vec3 ng = normal / (isFront ? length : -length);
        const glm::vec3 p = rays[i].origin + hits[i].t * rays[i].direction;
        const float size = std::max({hits[i].t, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        points.push_back({p + 1e-5f * size * ng, ng});
    }
    return points;
}

std::vector<Ray> makeBounceRays(std::span<const SurfacePoint> points, uint32_t seed) {
    Random random(seed);
    std::vector<Ray> rays;
    rays.reserve(points.size());
    for (const SurfacePoint& point : points)
        rays.push_back(freeRay(point.p, cosineDirection(point.ng, random)));
    return rays;
}

std::vector<ShadowRay> makeShadowRays(std::span<const SurfacePoint> points, const Scene& scene,
                                      std::span<const Triangle> triangles, uint32_t seed) {
    constexpr float kShare = 0.999f; // share of the way to the light
    const Emitters emitters = findEmitters(scene);
    const std::vector<AliasEntry> table = tableByPower(emitters);
    Random random(seed);
    std::vector<ShadowRay> rays;
    rays.reserve(points.size());
    for (const SurfacePoint& point : points) {
        const glm::vec3 way =
            table.empty()
                ? 2.0f * scene.bounds.radius() * cosineDirection(point.ng, random)
                : pointOn(triangles[emitters.list[pickFrom(table, random)].triangle], random) - point.p;
        rays.push_back({point.p, kNoSurface, kShare * way, kNoSurface, glm::vec3(0.0f), 0.0f});
    }
    return rays;
}

} // namespace lavalight
