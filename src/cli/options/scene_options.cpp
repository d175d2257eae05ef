#include "cli/options/scene_options.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {

void addAllowExternal(CLI::App& parser, ImportOptions& options) {
    parser.add_flag("--allow-external", options.allowsExternal,
                    "The scene may refer to files outside its folder; never to other addresses");
}

SceneOptions::SceneOptions(CLI::App& parser) : parser_(&parser) {
    parser
        .add_option("--at", seconds_,
                    "Time of the animation; default: nothing is animated. Its first and last keys hold "
                    "before and after it")
        ->type_name("SECONDS")
        ->default_str("");
    parser
        .add_option("--animation", options_.animation,
                    "Animation by name or index (see lavalight info); default: the first")
        ->type_name("NAME|INDEX");
    parser
        .add_option("--scene", options_.scene,
                    "Scene of the file by name or index (see lavalight info); default: the one it names")
        ->type_name("NAME|INDEX");
    parser
        .add_option("--variant", options_.variant,
                    "Variant of the materials by name or index (see lavalight info)")
        ->type_name("NAME|INDEX");
    addAllowExternal(parser, options_);
}

ImportOptions SceneOptions::importOptions() const {
    ImportOptions options = options_;
    if (parser_->count("--at") > 0) {
        if (!std::isfinite(seconds_))
            throw UsageError(fmt::format("--at: {} is not a time in seconds", seconds_));
        options.seconds = seconds_;
    } else if (!options.animation.empty()) {
        throw UsageError("--animation: needs a time; give --at SECONDS");
    }
    return options;
}

ImportOptions SceneOptions::importOptionsAt(double seconds) const {
    if (parser_->count("--at") > 0)
        throw UsageError("--at: frames have times of their own; give --at, or --frames or --frame");
    ImportOptions options = options_;
    options.seconds = seconds;
    return options;
}

} // namespace lavalight
