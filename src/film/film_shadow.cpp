#include "film/film_shadow.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "film/film_layout.h"
#include "shared/shadow.h"

namespace lavalight {
namespace {

Image* meanOf(Rendering& rendering, uint32_t row) {
    for (Layer& layer : rendering.layers)
        if (layer.name == planeName(row))
            return &layer.mean;
    return nullptr;
}

// Not below 0 by rounding: what a pixel filter makes negative stays so.
glm::vec3 without(const glm::vec3& light, const glm::vec3& kept) {
    return glm::max(light - kept, glm::min(light, glm::vec3(0.0f)));
}

} // namespace

float shadowShare(const glm::vec3& shadow) {
    return shadowOf(shadow.y, shadow.z);
}

float shadowAlpha(const glm::vec3& shadow) {
    return shadow.x * shadowShare(shadow);
}

void castShadows(Rendering& rendering, size_t firstPixel, size_t pixels) {
    const Image* const shadows = meanOf(rendering, kShadowPlane);
    if (shadows == nullptr)
        return;
    Image* const coverage = meanOf(rendering, kCoveragePlane);
    const Image* const behind = meanOf(rendering, kBehindPlane);
    std::vector<Image*> darkened;
    for (const uint32_t row : {kColorPlane, kEmissionPlane, kDirectPlane})
        if (Image* const image = meanOf(rendering, row))
            darkened.push_back(image);
    for (size_t i = firstPixel; i < firstPixel + pixels; ++i) {
        const glm::vec3& shadow = shadows->pixels[i];
        if (coverage != nullptr)
            coverage->pixels[i].x = std::min(coverage->pixels[i].x + shadowAlpha(shadow), 1.0f);
        if (behind == nullptr)
            continue;
        const glm::vec3 kept = shadowShare(shadow) * behind->pixels[i];
        for (Image* const image : darkened)
            image->pixels[i] = without(image->pixels[i], kept);
    }
}

// Where nothing is covered, the difference is 0 exactly.
std::optional<Image> coverageWithoutShadow(const Rendering& rendering) {
    const Layer* coverage = rendering.find(kCoverageLayer);
    if (coverage == nullptr)
        return std::nullopt;
    Image image = coverage->mean;
    if (const Layer* shadow = rendering.find(planeName(kShadowPlane)))
        for (size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i].x = std::max(image.pixels[i].x - shadowAlpha(shadow->mean.pixels[i]), 0.0f);
    return image;
}

} // namespace lavalight
