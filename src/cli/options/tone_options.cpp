#include "cli/options/tone_options.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parse.h"
#include "cli/options/named_option.h"

namespace lavalight {

ToneOptions::ToneOptions(CLI::App& parser) : parser_(&parser) {
    addNamed(parser, "--tonemap", tone_.curve,
             "Curve from radiance to the display: Khronos PBR Neutral, none (clamped), AgX, ACES");
    parser
        .add_option(
            "--exposure", exposure_,
            "Stops of exposure before the curve; auto: the log-average luminance becomes middle grey, of "
            "what is covered where --background leaves the rest out")
        ->type_name("STOPS|auto");
}

ToneSettings ToneOptions::settings() const {
    ToneSettings tone = tone_;
    if (isAutomatic())
        return tone;
    const std::optional<float> stops = parseNumber<float>(exposure_);
    if (!stops || !std::isfinite(*stops))
        throw UsageError(fmt::format("--exposure: \"{}\" is neither a number of stops nor auto", exposure_));
    tone.exposure = *stops;
    return tone;
}

bool ToneOptions::isGiven() const {
    return parser_->count("--tonemap") > 0 || parser_->count("--exposure") > 0;
}

} // namespace lavalight
