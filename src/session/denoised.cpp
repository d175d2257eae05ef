#include "session/denoised.h"

#include <cassert>
#include <cmath>
#include <string>

#include "film/film_layout.h"

namespace lavalight {
namespace {

std::string nameOfRow(uint32_t row) {
    return layoutOf(1u << kColorPlane | 1u << row).planes().back().name;
}

const Image& layerOf(const Rendering& rendering, uint32_t row) {
    const Layer* layer = rendering.find(nameOfRow(row));
    assert(layer != nullptr);
    return layer->mean;
}

// Of radiance: all but what is seen directly; means may be infinite where sums saturated.
Image withoutEmission(const Image& radiance, const Image& emission) {
    Image image(radiance.width, radiance.height);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        for (glm::length_t c = 0; c < 3; ++c) {
            const float rest = radiance.pixels[i][c] - emission.pixels[i][c];
            image.pixels[i][c] = rest > 0.0f && std::isfinite(rest) ? rest : 0.0f;
        }
    return image;
}

// The image of what is covered alone: values are divided by coverage, and 0 where there is none.
Image ofCovered(Image image, const Layer* coverage) {
    for (size_t i = 0; coverage != nullptr && i < image.pixels.size(); ++i) {
        const float share = coverage->mean.pixels[i].x;
        image.pixels[i] = share > 0.0f ? image.pixels[i] / share : glm::vec3(0.0f);
    }
    return image;
}

} // namespace

void denoise(Rendering& rendering, const Denoiser& denoiser, DenoiseQuality quality, uint32_t asked,
             bool isSharp) {
    const Layer* coverage = rendering.find(nameOfRow(kCoveragePlane));
    const Image none(rendering.radiance().width, rendering.radiance().height);
    const Image& keptLight = isSharp ? layerOf(rendering, kEmissionPlane) : none;
    Image image = denoiser.denoise(ofCovered(withoutEmission(rendering.radiance(), keptLight), coverage),
                                   {ofCovered(layerOf(rendering, kGuideAlbedoPlane), coverage),
                                    ofCovered(layerOf(rendering, kGuideNormalPlane), coverage)},
                                   quality);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const float share = coverage != nullptr ? coverage->mean.pixels[i].x : 1.0f;
        image.pixels[i] = share * image.pixels[i] + keptLight.pixels[i];
    }
    for (const uint32_t row : {kEmissionPlane, kGuideAlbedoPlane, kGuideNormalPlane})
        if ((asked >> row & 1u) == 0)
            std::erase_if(rendering.layers, [&](const Layer& layer) { return layer.name == nameOfRow(row); });
    const std::string prefix = kDenoisedLayer;
    rendering.layers.push_back(
        {kDenoisedLayer, {prefix + ".R", prefix + ".G", prefix + ".B"}, std::move(image), std::nullopt});
}

} // namespace lavalight
