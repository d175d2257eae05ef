#include "cli/options/layer_options.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "cli/options/option_values.h"
#include "film/film_layout.h"

namespace lavalight {
namespace {

// A layer that somebody may ask for; the others come with what needs them.
struct Offer {
    std::string name;
    uint32_t bit = 0;
};

std::vector<Offer> offers() {
    std::vector<Offer> offers;
    for (const uint32_t row : offeredRows())
        offers.push_back({planeName(row), 1u << row});
    for (const uint32_t bit : {kObjectIds, kMaterialIds, kCryptomatte})
        offers.push_back({layerNameOf(bit), bit});
    return offers;
}

std::vector<std::string> namesOf(const std::vector<Offer>& offers) {
    std::vector<std::string> names;
    for (const Offer& offer : offers)
        names.push_back(offer.name);
    return names;
}

} // namespace

LayerOptions::LayerOptions(CLI::App& parser) {
    parser
        .add_option(
            "--aov", names_,
            fmt::format("Layers of the EXR beside the colour, separated by commas: {}. They are means of the "
                        "samples, but for ids, of which the most frequent counts",
                        fmt::join(namesOf(offers()), ", ")))
        ->type_name("LIST");
}

uint32_t LayerOptions::layers() const {
    if (names_.empty())
        return 0;
    const std::vector<Offer> all = offers();
    uint32_t layers = 0;
    for (const std::string_view name : splitAt(names_, ',')) {
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const Offer& offer) { return offer.name == name; });
        if (found == all.end())
            throw UsageError(fmt::format("--aov: cannot record a layer \"{}\": it is not known; try {}", name,
                                         fmt::join(namesOf(all), ", ")));
        layers |= found->bit;
    }
    return layers;
}

} // namespace lavalight
