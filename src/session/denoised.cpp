#include "session/denoised.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "film/film_layout.h"
#include "film/film_shadow.h"

namespace lavalight {
namespace {

const Image& layerOf(const Rendering& rendering, uint32_t row) {
    const Layer* layer = rendering.find(planeName(row));
    assert(layer != nullptr);
    return layer->mean;
}

// All radiance but what is seen directly. Means may be infinite, where sums saturated.
Image withoutEmission(const Image& radiance, const Image& emission) {
    Image image(radiance.width, radiance.height);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        for (glm::length_t c = 0; c < 3; ++c) {
            const float rest = radiance.pixels[i][c] - emission.pixels[i][c];
            image.pixels[i][c] = rest > 0.0f && std::isfinite(rest) ? rest : 0.0f;
        }
    return image;
}

// Pixels around a covered one that get values, in rings.
constexpr int kRings = 16;

// Gives pixels without a value (`has` is 0) the mean of their neighbours that have one, ring by ring.
void spread(Image& image, std::vector<uint8_t> has) {
    const auto width = static_cast<int64_t>(image.width);
    const auto height = static_cast<int64_t>(image.height);
    for (int ring = 0; ring < kRings; ++ring) {
        const std::vector<uint8_t> before = has;
        for (int64_t y = 0; y < height; ++y)
            for (int64_t x = 0; x < width; ++x) {
                if (before[static_cast<size_t>(y * width + x)] != 0)
                    continue;
                glm::vec3 sum(0.0f);
                float count = 0.0f;
                for (int64_t v = std::max<int64_t>(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
                    for (int64_t u = std::max<int64_t>(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
                        if (before[static_cast<size_t>(v * width + u)] != 0) {
                            sum += image.pixels[static_cast<size_t>(v * width + u)];
                            count += 1.0f;
                        }
                if (count > 0.0f) {
                    image.pixels[static_cast<size_t>(y * width + x)] = sum / count;
                    has[static_cast<size_t>(y * width + x)] = 1;
                }
            }
    }
}

// The image as if it were covered everywhere: values are divided by coverage and go on beyond edges, so that
// these look like no edges of the scene.
Image ofCovered(Image image, const std::optional<Image>& coverage) {
    if (!coverage)
        return image;
    std::vector<uint8_t> has(image.pixels.size());
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const float share = coverage->pixels[i].x;
        has[i] = share > 0.0f ? 1 : 0;
        image.pixels[i] = share > 0.0f ? image.pixels[i] / share : glm::vec3(0.0f);
    }
    spread(image, std::move(has));
    return image;
}

// Shares where their 3 by 3 pixels are alike, and what a denoiser makes of them elsewhere: at edges, and
// behind what is transparent by chance.
std::optional<Image> denoisedShares(const Image& shares, const DenoiseGuides& guides,
                                    const Denoiser& denoiser, DenoiseQuality quality,
                                    const KeepGoing& keepGoing) {
    Image grey(shares.width, shares.height);
    for (size_t i = 0; i < grey.pixels.size(); ++i)
        grey.pixels[i] = glm::vec3(shares.pixels[i].x);
    std::optional<Image> denoised = denoiser.denoise(grey, guides, quality, ImageKind::display, keepGoing);
    if (!denoised)
        return std::nullopt;
    Image& clean = *denoised;
    for (uint32_t y = 0; y < shares.height; ++y)
        for (uint32_t x = 0; x < shares.width; ++x) {
            const float here = shares.at(x, y).x;
            bool isAlike = true;
            for (uint32_t v = y - std::min(y, 1u); v <= std::min(y + 1, shares.height - 1); ++v)
                for (uint32_t u = x - std::min(x, 1u); u <= std::min(x + 1, shares.width - 1); ++u)
                    isAlike = isAlike && shares.at(u, v).x == here;
            glm::vec3& pixel = clean.pixels[size_t{y} * shares.width + x];
            pixel = {isAlike ? here : std::clamp(pixel.x, 0.0f, 1.0f), 0.0f, 0.0f};
        }
    return denoised;
}

// The largest x of the 3 by 3 pixels around one.
float largestAround(const Image& image, uint32_t x, uint32_t y) {
    float largest = 0.0f;
    for (uint32_t v = y - std::min(y, 1u); v <= std::min(y + 1, image.height - 1); ++v)
        for (uint32_t u = x - std::min(x, 1u); u <= std::min(x + 1, image.width - 1); ++u)
            largest = std::max(largest, image.at(u, v).x);
    return largest;
}

// The shadow on the ground alone. It goes on below the model, and pixels of the model's edge, where few
// samples say something of it, take it from their neighbours. A guide of where the ground is keeps their
// noise, which is then wider than a pixel, from passing for a shape.
std::optional<Image> denoisedShadow(const Image& shadows, const Denoiser& denoiser, DenoiseQuality quality,
                                    const KeepGoing& keepGoing) {
    Image shares(shadows.width, shadows.height);
    std::vector<uint8_t> isGround(shadows.pixels.size());
    for (uint32_t y = 0; y < shadows.height; ++y)
        for (uint32_t x = 0; x < shadows.width; ++x) {
            const glm::vec3& shadow = shadows.at(x, y);
            const size_t i = size_t{y} * shadows.width + x;
            isGround[i] = shadow.x > 0.5f * largestAround(shadows, x, y) ? 1 : 0;
            shares.pixels[i].x = shadowShare(shadow);
        }
    DenoiseGuides guides{Image(shadows.width, shadows.height), Image(shadows.width, shadows.height)};
    for (size_t i = 0; i < isGround.size(); ++i)
        guides.albedo.pixels[i] = glm::vec3(isGround[i]);
    spread(shares, std::move(isGround));
    return denoisedShares(shares, guides, denoiser, quality, keepGoing);
}

// What clean shadows are of alpha. The share of the pixel that is ground follows the clean coverage.
Image alphaOfShadow(const Image& shadows, const Image& clean, const Image& covered,
                    const Image& cleanCovered) {
    Image alpha(shadows.width, shadows.height);
    for (size_t i = 0; i < alpha.pixels.size(); ++i) {
        const float open = 1.0f - covered.pixels[i].x;
        const float ground =
            open > 0.0f ? shadows.pixels[i].x / open * (1.0f - cleanCovered.pixels[i].x) : 0.0f;
        alpha.pixels[i].x = ground * clean.pixels[i].x;
    }
    return alpha;
}

// Gives light that is seen directly the clean shadow in the place of its own.
void exchangeShadow(const Image& shadows, const Image& clean, const Image& behind, Image& light) {
    for (size_t i = 0; i < light.pixels.size(); ++i) {
        const float own = shadowShare(shadows.pixels[i]);
        light.pixels[i] =
            glm::max(light.pixels[i] + (own - clean.pixels[i].x) * behind.pixels[i], glm::vec3(0.0f));
    }
}

} // namespace

void removeGuides(Rendering& rendering, uint32_t asked) {
    for (const uint32_t row : {kEmissionPlane, kGuideAlbedoPlane, kGuideNormalPlane})
        if ((asked >> row & 1u) == 0)
            std::erase_if(rendering.layers, [&](const Layer& layer) { return layer.name == planeName(row); });
}

bool denoise(Rendering& rendering, const Denoiser& denoiser, DenoiseQuality quality, uint32_t asked,
             bool isSharp, const KeepGoing& keepGoing) {
    const std::optional<Image> coverage = coverageWithoutShadow(rendering);
    const Image none(rendering.radiance().width, rendering.radiance().height);
    Image keptLight = isSharp ? layerOf(rendering, kEmissionPlane) : none;
    const DenoiseGuides guides{layerOf(rendering, kGuideAlbedoPlane), layerOf(rendering, kGuideNormalPlane)};
    std::optional<Image> denoised =
        denoiser.denoise(ofCovered(withoutEmission(rendering.radiance(), keptLight), coverage),
                         {ofCovered(guides.albedo, coverage), ofCovered(guides.normal, coverage)}, quality,
                         ImageKind::radiance, keepGoing);
    std::optional<Image> alpha;
    if (denoised && coverage)
        alpha = denoisedShares(*coverage, guides, denoiser, quality, keepGoing);
    if (!denoised || (coverage && !alpha))
        return false;
    Image& image = *denoised;
    std::optional<Image> shadow;
    if (rendering.find(planeName(kShadowPlane)) != nullptr) {
        const Image& shadows = layerOf(rendering, kShadowPlane);
        const std::optional<Image> clean = denoisedShadow(shadows, denoiser, quality, keepGoing);
        if (!clean)
            return false;
        if (coverage)
            shadow = alphaOfShadow(shadows, *clean, *coverage, *alpha);
        else if (isSharp)
            exchangeShadow(shadows, *clean, layerOf(rendering, kBehindPlane), keptLight);
    }
    for (size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = (alpha ? alpha->pixels[i].x : 1.0f) * image.pixels[i] + keptLight.pixels[i];
    removeGuides(rendering, asked);
    const std::string prefix = kDenoisedLayer;
    rendering.layers.push_back(
        {kDenoisedLayer, {prefix + ".R", prefix + ".G", prefix + ".B"}, std::move(image), std::nullopt});
    if (alpha && shadow)
        for (size_t i = 0; i < alpha->pixels.size(); ++i)
            alpha->pixels[i].x = std::min(alpha->pixels[i].x + shadow->pixels[i].x, 1.0f);
    if (alpha)
        rendering.layers.push_back({kDenoisedCoverage, {kDenoisedCoverage}, std::move(*alpha), std::nullopt});
    if (shadow)
        rendering.layers.push_back(
            {kDenoisedShadow, {std::string(kDenoisedShadow) + ".N"}, std::move(*shadow), std::nullopt});
    return true;
}

} // namespace lavalight
