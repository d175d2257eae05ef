#include "film/id_layers.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "film/cryptomatte.h"
#include "film/film_file.h"

namespace lavalight {
namespace {

// Whether "a,b,c" lists the name.
bool lists(const std::string& names, const std::string& name) {
    return ("," + names + ",").find("," + name + ",") != std::string::npos;
}

std::vector<std::string> namesIn(const Metadata& metadata, const std::string& layer) {
    const auto json = nlohmann::json::parse(valueOf(metadata, namesKey(layer)), nullptr, false);
    std::vector<std::string> names;
    if (json.is_array())
        for (const auto& name : json)
            names.push_back(name.is_string() ? name.get<std::string>() : std::string());
    return names;
}

} // namespace

std::string namesKey(const std::string& layer) {
    return fmt::format("names:{}", layer);
}

std::string textOf(const std::vector<std::string>& names) {
    return nlohmann::json(names).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void addIdLayers(const std::vector<IdLayer>& ids, const std::vector<uint32_t>& samples,
                 const Metadata& metadata, ExrContents& contents) {
    const std::string asked = valueOf(metadata, "option:aov");
    for (const IdLayer& layer : ids) {
        if (lists(asked, layer.name)) {
            OwnedChannel<uint32_t> image{layer.name, std::vector<uint32_t>(layer.counts.pixels())};
            for (size_t pixel = 0; pixel < layer.counts.pixels(); ++pixel)
                if (const std::vector<IdCount> ranked = layer.counts.ranked(pixel); !ranked.empty())
                    image.values[pixel] = ranked.front().id;
            contents.uints.push_back(std::move(image));
        }
        if (lists(asked, layerNameOf(kCryptomatte))) {
            const bool isObjects = layer.name == layerNameOf(kObjectIds);
            Cryptomatte matte = makeCryptomatte(isObjects ? "CryptoObject" : "CryptoMaterial", layer.counts,
                                                namesIn(metadata, layer.name), samples);
            std::move(matte.channels.begin(), matte.channels.end(), std::back_inserter(contents.floats));
            contents.attributes.insert(contents.attributes.end(), matte.attributes.begin(),
                                       matte.attributes.end());
        }
    }
}

} // namespace lavalight
