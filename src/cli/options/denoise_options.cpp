#include "cli/options/denoise_options.h"

#include <fmt/format.h>

#include "session/denoise_names.h"

namespace lavalight {

DenoiseOptions::DenoiseOptions(CLI::App& parser, const DenoiseUse& use)
    : parser_(&parser), default_(use.quality) {
    parser.add_option("--denoise", quality_, use.help)
        ->type_name("high|balanced|fast")
        ->expected(0, 1)
        ->check(CLI::Validator(
            [](std::string& word) {
                return word.empty() || word == "high" || word == "balanced" || word == "fast"
                           ? std::string()
                           : fmt::format(
                                 "{} is neither high, nor balanced, nor fast; put the scene first, or write "
                                 "--denoise=high",
                                 word);
            },
            ""));
}

std::optional<DenoiseQuality> DenoiseOptions::quality() const {
    if (parser_->count("--denoise") == 0)
        return std::nullopt;
    for (const SettingName<DenoiseQuality>& name : settingNames<DenoiseQuality>())
        if (name.name == quality_)
            return name.value;
    return default_;
}

} // namespace lavalight
