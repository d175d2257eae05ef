// Which channels of a file make which layer.
#include "image/exr_layers.h"

#include <gtest/gtest.h>

namespace lavalight {
namespace {

TEST(ExrLayers, AlphaOfALayerOfColourIsALayer) {
    std::vector<ExrChannel> channels;
    for (const char* name : {"A", "B", "G", "R", "glow.A", "glow.B", "glow.G", "glow.R", "mist.A", "mist.Z"})
        channels.push_back({name});
    const std::vector<Layer> layers = layersIn(channels);
    std::vector<std::string> names;
    names.reserve(layers.size());
    for (const Layer& layer : layers)
        names.push_back(layer.name);
    EXPECT_EQ(names, (std::vector<std::string>{"color", "A", "glow", "glow.A", "mist"}));
    EXPECT_EQ(layers[2].channels, (std::vector<std::string>{"glow.R", "glow.G", "glow.B"}));
    EXPECT_EQ(layers[3].channels, (std::vector<std::string>{"glow.A"}));
}

} // namespace
} // namespace lavalight
