#include "session/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "film/film_shadow.h"

namespace lavalight {
namespace {

constexpr double kMiddleGrey = 0.18;

// Signals that are all but white or black.
constexpr uint32_t kWhite = 250;
constexpr uint32_t kBlack = 5;

// Luminance of linear Rec. 709.
double luminance(const glm::vec3& color) {
    return glm::dot(glm::dvec3(color), glm::dvec3(0.2126, 0.7152, 0.0722));
}

} // namespace

float autoExposure(const Rendering& rendering) {
    const std::optional<Image> coverage = coverageWithoutShadow(rendering);
    const std::vector<glm::vec3>& pixels = rendering.radiance().pixels;
    double sum = 0.0;
    double weights = 0.0;
    for (size_t i = 0; i < pixels.size(); ++i) {
        const double weight = coverage ? coverage->pixels[i].x : 1.0;
        const double light = luminance(pixels[i]);
        if (!(weight > 0.0) || !(light > 0.0))
            continue;
        sum += weight * std::log2(light / weight);
        weights += weight;
    }
    return weights > 0.0 ? static_cast<float>(std::log2(kMiddleGrey) - sum / weights) : 0.0f;
}

std::string extremesText(std::span<const uint32_t> pixels, const Image* coverage, const std::string& advice) {
    size_t seen = 0;
    size_t white = 0;
    size_t black = 0;
    for (size_t i = 0; i < pixels.size(); ++i) {
        if (coverage != nullptr && coverage->pixels[i].x == 0.0f)
            continue;
        const uint32_t red = pixels[i] & 0xffu;
        const uint32_t green = pixels[i] >> 8 & 0xffu;
        const uint32_t blue = pixels[i] >> 16 & 0xffu;
        ++seen;
        white += red >= kWhite && green >= kWhite && blue >= kWhite ? 1 : 0;
        black += red <= kBlack && green <= kBlack && blue <= kBlack ? 1 : 0;
    }
    const size_t most = std::max(white, black);
    if (2 * most <= seen)
        return {};
    return fmt::format("{:.0f} % of the picture is {}{}{}",
                       100.0 * static_cast<double>(most) / static_cast<double>(seen),
                       white > black ? "white" : "black", advice.empty() ? "" : "; try ", advice);
}

} // namespace lavalight
