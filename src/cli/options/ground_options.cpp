#include "cli/options/ground_options.h"

#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/options/option_values.h"

namespace lavalight {

GroundOptions::GroundOptions(CLI::App& parser) {
    parser
        .add_option(
            "--ground", ground_,
            "What lies right below the scene: nothing; a matt surface of that colour; or a plane that "
            "catches shadows and shows the background, whose shadow is part of alpha")
        ->type_name("none|#rrggbb|shadow");
}

GroundSettings GroundOptions::settings() const {
    if (ground_ == "none")
        return {};
    if (ground_ == "shadow")
        return {Ground::shadow, 0};
    const std::optional<uint32_t> color = parseHexColor(ground_);
    if (!color)
        throw UsageError(fmt::format(
            "--ground: cannot use \"{}\": it is not known; try none, shadow, or a colour #rrggbb", ground_));
    return {Ground::lambert, *color};
}

} // namespace lavalight
