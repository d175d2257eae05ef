#include "view/layer_display.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "film/film_layout.h"
#include "image/srgb.h"

namespace lavalight {
namespace {

// Points a side of a square of the ground, and its greys.
constexpr uint32_t kSquare = 8;
constexpr uint32_t kLightGrey = 0x99;
constexpr uint32_t kDarkGrey = 0x66;

// Signal of the farthest depth, which is told from where nothing was hit.
constexpr float kFarthest = 0.1f;

constexpr uint32_t kOpaque = 0xff000000u;

uint32_t opaque(const glm::uvec3& code) {
    return code.r | code.g << 8u | code.b << 16u | kOpaque;
}

// Display values as they are.
uint32_t fromSignal(const glm::vec3& signal) {
    return opaque(glm::uvec3(255.0f * glm::clamp(signal, 0.0f, 1.0f) + 0.5f));
}

uint32_t fromLinear(const glm::vec3& color) {
    return opaque({encodeSrgb8(color.r), encodeSrgb8(color.g), encodeSrgb8(color.b)});
}

// Least and largest values of the pixels that have any, by component; infinite ones do not count.
struct Range {
    glm::vec3 least{std::numeric_limits<float>::max()};
    glm::vec3 most{std::numeric_limits<float>::lowest()};

    void take(const glm::vec3& value) {
        for (glm::length_t c = 0; c < 3; ++c)
            if (std::isfinite(value[c])) {
                least[c] = std::min(least[c], value[c]);
                most[c] = std::max(most[c], value[c]);
            }
    }
    // Where a value is from the least (0) to the largest (1).
    [[nodiscard]] glm::vec3 share(const glm::vec3& value) const {
        glm::vec3 share(0.0f);
        for (glm::length_t c = 0; c < 3; ++c)
            share[c] = most[c] > least[c] ? (value[c] - least[c]) / (most[c] - least[c]) : 0.0f;
        return share;
    }
};

} // namespace

std::vector<uint32_t> displayOf(const Rendering& layers, uint32_t row, float scale) {
    const Layer* layer = layers.find(planeName(row));
    assert(layer != nullptr);
    const FilmPlane shape = shapeOf(row, 0);
    const std::vector<glm::vec3>& values = layer->mean.pixels;
    const Layer* hits = shape.isPerHit != 0 ? layers.find(planeName(kHitsPlane)) : nullptr;
    const auto has = [&](size_t i) { return hits == nullptr || hits->mean.pixels[i].x > 0.0f; };
    const bool isColor = shape.components == 3 && shape.isSigned == 0;
    Range range;
    if (!isColor && row != kNormalPlane)
        for (size_t i = 0; i < values.size(); ++i)
            if (has(i))
                range.take(values[i]);
    const auto shown = [&](const glm::vec3& value) {
        if (isColor)
            return fromLinear(row == kAlbedoPlane ? value : scale * value);
        if (row == kNormalPlane)
            return fromSignal(0.5f * value + 0.5f);
        const glm::vec3 share = range.share(value);
        if (row == kDepthPlane)
            return fromSignal(glm::vec3(1.0f - (1.0f - kFarthest) * share.x));
        return fromSignal(shape.components == 1 ? glm::vec3(share.x) : share);
    };
    std::vector<uint32_t> pixels(values.size(), kOpaque);
    for (size_t i = 0; i < values.size(); ++i)
        if (has(i))
            pixels[i] = shown(values[i]);
    return pixels;
}

void putOnCheckerboard(std::span<uint32_t> pixels, uint32_t width, const glm::uvec2& window) {
    const auto height = static_cast<uint32_t>(pixels.size() / width);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            uint32_t& pixel = pixels[size_t{y} * width + x];
            const uint32_t alpha = pixel >> 24u;
            if (alpha == 255)
                continue;
            const uint32_t column = x * window.x / width / kSquare;
            const uint32_t row = y * window.y / height / kSquare;
            const uint32_t ground = (column + row) % 2 == 0 ? kLightGrey : kDarkGrey;
            glm::uvec3 code(pixel & 255u, pixel >> 8u & 255u, pixel >> 16u & 255u);
            code = (code * alpha + ground * (255 - alpha) + 127u) / 255u;
            pixel = opaque(code);
        }
}

} // namespace lavalight
