#include "image/exr_layers.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {
namespace {

using Names = std::vector<std::string>;
using Channels = std::span<const ExrChannel>;

constexpr std::string_view kVariance = "variance."; // prefix of the channel's name

std::string textOf(Channels channels) {
    std::string names;
    for (const ExrChannel& channel : channels)
        names += (names.empty() ? "" : ", ") + channel.name;
    return names;
}

bool has(Channels channels, std::string_view name) {
    return std::any_of(channels.begin(), channels.end(),
                       [&](const ExrChannel& c) { return c.name == name && c.hasAllPixels; });
}

bool hasAll(Channels channels, const Names& names) {
    return std::all_of(names.begin(), names.end(), [&](const std::string& n) { return has(channels, n); });
}

// Y beside chroma (RY, BY) is an encoded colour image, which grey would misread.
bool isLuminance(Channels channels) {
    return has(channels, kLuminance) &&
           std::none_of(channels.begin(), channels.end(),
                        [](const ExrChannel& c) { return c.name == "RY" || c.name == "BY"; });
}

// "normal" of "normal.X"; a channel without a dot is a layer of its own.
std::string layerOf(const std::string& channel) {
    return channel.substr(0, channel.rfind('.'));
}

// R, G, B in that order, all others as they are.
Names inOrder(const std::string& layer, const Names& channels) {
    const Names color{layer + ".R", layer + ".G", layer + ".B"};
    return std::is_permutation(channels.begin(), channels.end(), color.begin(), color.end()) ? color
                                                                                             : channels;
}

bool isAlpha(std::string_view channel) {
    return channel == "A" || channel.ends_with(".A");
}

// Cryptomattes hold hashes of names: "CryptoObject00.R".
bool isMatte(std::string_view channel) {
    const std::string_view layer = channel.substr(0, channel.rfind('.'));
    return layer.size() > 2 && layer.find("Crypto") != std::string_view::npos &&
           std::isdigit(static_cast<unsigned char>(layer[layer.size() - 1])) != 0 &&
           std::isdigit(static_cast<unsigned char>(layer[layer.size() - 2])) != 0;
}

bool mayBeLayer(const ExrChannel& channel) {
    const bool isColor =
        channel.name == "R" || channel.name == "G" || channel.name == "B" || channel.name == kLuminance;
    const bool isNumber = channel.isFloat || isAlpha(channel.name); // whole numbers are 0 or 1
    return !isColor && isNumber && channel.hasAllPixels && !channel.name.starts_with(kVariance) &&
           !isMatte(channel.name);
}

// The opacity of a layer of colour is a layer of its own.
void splitAlpha(std::map<std::string, Names>& byLayer) {
    Names alphas;
    for (auto& [name, channels] : byLayer) {
        const std::string alpha = name + ".A";
        if (channels.size() == kMostComponents + 1 && std::erase(channels, alpha) > 0)
            alphas.push_back(alpha);
    }
    for (const std::string& alpha : alphas)
        byLayer[alpha] = {alpha};
}

} // namespace

std::vector<std::string> varianceChannels(const std::vector<std::string>& channels) {
    Names names;
    for (const std::string& channel : channels)
        names.push_back(std::string(kVariance) + channel);
    return names;
}

Layer colorLayerIn(std::span<const ExrChannel> channels) {
    Layer layer = colorLayer({}, std::nullopt);
    if (hasAll(channels, layer.channels))
        return layer;
    if (!isLuminance(channels))
        throw Error(fmt::format("it lacks channels R, G, B (or Y alone) at full resolution; it has {}",
                                textOf(channels)));
    layer.channels = {kLuminance};
    return layer;
}

std::vector<Layer> layersIn(std::span<const ExrChannel> channels) {
    std::map<std::string, Names> byLayer;
    for (const ExrChannel& channel : channels)
        if (mayBeLayer(channel))
            byLayer[layerOf(channel.name)].push_back(channel.name);
    splitAlpha(byLayer);
    std::vector<Layer> layers{colorLayerIn(channels)};
    for (const auto& [name, itsChannels] : byLayer)
        if (itsChannels.size() <= kMostComponents && name != kColorLayer)
            layers.push_back({name, inOrder(name, itsChannels), {}, std::nullopt});
    for (Layer& layer : layers)
        if (hasAll(channels, varianceChannels(layer.channels)))
            layer.variance.emplace();
    return layers;
}

} // namespace lavalight
