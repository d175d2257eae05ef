#include "cli/options/tone_options.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/options/named_option.h"

namespace lavalight {

ToneOptions::ToneOptions(CLI::App& parser) : parser_(&parser) {
    addNamed(parser, "--tonemap", tone_.curve,
             "Curve from radiance to the display: clamped, Khronos PBR Neutral, AgX, ACES");
    parser.add_option("--exposure", tone_.exposure, "Stops of exposure before the curve")->type_name("STOPS");
}

ToneSettings ToneOptions::settings() const {
    if (!std::isfinite(tone_.exposure))
        throw UsageError(fmt::format("--exposure: {} is not a number of stops", tone_.exposure));
    return tone_;
}

bool ToneOptions::isGiven() const {
    return parser_->count("--tonemap") > 0 || parser_->count("--exposure") > 0;
}

} // namespace lavalight
