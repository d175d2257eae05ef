// What a render leaves behind: layers of an image, with what is known of their noise.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/image.h"

namespace lavalight {

// Where an image is in a whole that it is a part of.
struct ImagePlace {
    glm::uvec2 first{0}; // of the whole's pixels, from the top left corner, the image's first
    glm::uvec2 whole{0}; // width and height
    bool operator==(const ImagePlace&) const = default;
};

// Means of one kind over the samples of each pixel.
struct Layer {
    std::string name;
    std::vector<std::string> channels; // one to three: what EXR files call the components
    Image mean;                        // components without a channel are 0
    // Variance of the mean, per channel; 0 where fewer than two samples were taken.
    std::optional<Image> variance;
};

// The layer of radiance.
inline constexpr const char* kColorLayer = "color";
// The layer of the share of camera paths that met something.
inline constexpr const char* kCoverageLayer = "coverage";

[[nodiscard]] inline Layer colorLayer(Image mean, std::optional<Image> variance) {
    return {kColorLayer, {"R", "G", "B"}, std::move(mean), std::move(variance)};
}

[[nodiscard]] inline uint64_t totalOf(std::span<const uint32_t> counts) {
    return std::accumulate(counts.begin(), counts.end(), uint64_t{0});
}

struct Rendering {
    std::vector<Layer> layers;          // layers of one size and with different names; the first is radiance
    std::vector<uint32_t> sampleCounts; // row by row from the top; empty: not known
    std::optional<ImagePlace> place;    // none: the image is whole

    Rendering() = default;
    Rendering(Image radiance, std::optional<Image> variance, std::vector<uint32_t> counts)
        : sampleCounts(std::move(counts)) {
        layers.push_back(colorLayer(std::move(radiance), std::move(variance)));
    }

    [[nodiscard]] const Image& radiance() const& { return color().mean; }
    [[nodiscard]] Image& radiance() & { return color().mean; }
    [[nodiscard]] Image radiance() && { return std::move(color().mean); }

    [[nodiscard]] bool hasVariance() const { return color().variance.has_value(); }
    // The variance of radiance, which there must be.
    [[nodiscard]] const Image& variance() const& { return color().variance.value(); }
    [[nodiscard]] Image& variance() & { return color().variance.value(); }
    [[nodiscard]] Image variance() && { return std::move(color().variance).value(); }

    // Samples over all pixels.
    [[nodiscard]] uint64_t samples() const { return totalOf(sampleCounts); }

    // The layer of that name, or null.
    [[nodiscard]] const Layer* find(std::string_view name) const {
        const auto found = std::find_if(layers.begin(), layers.end(),
                                        [&](const Layer& layer) { return layer.name == name; });
        return found == layers.end() ? nullptr : &*found;
    }
    // The mean of the layer of that name, or null.
    [[nodiscard]] const Image* findMean(std::string_view name) const {
        const Layer* layer = find(name);
        return layer == nullptr ? nullptr : &layer->mean;
    }

  private:
    [[nodiscard]] const Layer& color() const {
        assert(!layers.empty());
        return layers.front();
    }
    [[nodiscard]] Layer& color() {
        assert(!layers.empty());
        return layers.front();
    }
};

} // namespace lavalight
