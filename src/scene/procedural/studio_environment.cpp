#include "scene/procedural/studio_environment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "base/parallel.h"

namespace lavalight {
namespace {

constexpr uint32_t kWidth = 1024;
constexpr uint32_t kHeight = 512;

// Radiances of the walls, before kScale.
constexpr float kFloor = 0.22f;
constexpr float kHorizon = 0.58f;
constexpr float kCeiling = 0.4f;
// Sines of the elevations between which they blend.
constexpr float kFloorEnds = -0.9f;
constexpr float kHorizonAt = 0.05f;
constexpr float kCeilingBegins = 0.9f;

constexpr float kScale = 0.617f; // makes the largest irradiance 3.7

// A rectangle at distance 1, which faces the model.
struct SoftBox {
    glm::vec3 towards; // from the model; of any length
    glm::vec2 halfSize;
    float radiance; // in its middle, before kScale
};
constexpr std::array<SoftBox, 5> kBoxes{{{{-0.6f, 0.85f, 0.8f}, {0.45f, 0.45f}, 6.0f},    // the main light
                                         {{1.0f, 0.3f, 0.5f}, {0.45f, 0.6f}, 1.1f},       // fills its shadows
                                         {{0.0f, 1.0f, -0.25f}, {0.7f, 0.3f}, 2.2f},      // overhead
                                         {{-0.85f, 0.95f, -0.75f}, {0.14f, 0.55f}, 5.5f}, // left edge
                                         {{0.9f, 0.95f, -0.8f}, {0.14f, 0.55f}, 4.5f}}};  // right edge
constexpr float kBlur = 0.02f; // of a box's edges, in its lengths
constexpr float kFall = 0.3f;  // share of its radiance that a box loses towards its corners

float smoothStep(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

float wallRadiance(float y) {
    return y < kHorizonAt ? glm::mix(kFloor, kHorizon, smoothStep(kFloorEnds, kHorizonAt, y))
                          : glm::mix(kHorizon, kCeiling, smoothStep(kHorizonAt, kCeilingBegins, y));
}

// A box with the axes of its rectangle.
struct PlacedBox {
    glm::vec3 normal;
    glm::vec3 right;
    glm::vec3 up;
    glm::vec2 halfSize;
    float radiance;
};

PlacedBox placed(const SoftBox& box) {
    const glm::vec3 normal = glm::normalize(box.towards);
    const glm::vec3 vertical =
        std::abs(normal.y) < 0.95f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(0.0f, 0.0f, -1.0f);
    const glm::vec3 right = glm::normalize(glm::cross(vertical, normal));
    return {normal, right, glm::cross(normal, right), box.halfSize, box.radiance};
}

// What is seen in direction d, of what lies behind the box and the box.
float seenThrough(const PlacedBox& box, const glm::vec3& d, float behind) {
    const float across = glm::dot(d, box.normal);
    if (across <= 0.0f)
        return behind;
    const glm::vec2 place = glm::vec2(glm::dot(d, box.right), glm::dot(d, box.up)) / across;
    const glm::vec2 inside = box.halfSize - glm::abs(place);
    if (inside.x <= -kBlur || inside.y <= -kBlur)
        return behind;
    const float cover = smoothStep(-kBlur, kBlur, inside.x) * smoothStep(-kBlur, kBlur, inside.y);
    const glm::vec2 share = place / box.halfSize;
    const float fall = 1.0f - kFall * std::min(1.0f, 0.5f * glm::dot(share, share));
    return glm::mix(behind, box.radiance * fall, cover);
}

} // namespace

Image makeStudio() {
    std::array<PlacedBox, kBoxes.size()> boxes{};
    std::transform(kBoxes.begin(), kBoxes.end(), boxes.begin(), placed);
    Image map(kWidth, kHeight);
    forEachInParallel(kHeight, [&](size_t row) {
        const float theta = glm::pi<float>() * (static_cast<float>(row) + 0.5f) / kHeight;
        const float wall = wallRadiance(std::cos(theta));
        for (uint32_t x = 0; x < kWidth; ++x) {
            const float phi = 2.0f * glm::pi<float>() * ((static_cast<float>(x) + 0.5f) / kWidth - 0.5f);
            const glm::vec3 d(std::cos(phi) * std::sin(theta), std::cos(theta),
                              std::sin(phi) * std::sin(theta));
            float radiance = wall;
            for (const PlacedBox& box : boxes)
                radiance = seenThrough(box, d, radiance);
            map.pixels[row * kWidth + x] = glm::vec3(kScale * radiance);
        }
    });
    return map;
}

} // namespace lavalight
