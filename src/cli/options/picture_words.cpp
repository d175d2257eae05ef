#include "cli/options/picture_words.h"

#include <algorithm>

#include <CLI/CLI.hpp>

#include "base/error.h"
#include "cli/options/picture_options.h"

namespace lavalight {

std::vector<PictureOption> pictureOptions() {
    CLI::App parser;
    const PictureOptions options(parser);
    std::vector<PictureOption> found;
    for (const CLI::Option* option : parser.get_options()) {
        const std::string name = option->get_single_name();
        // Options without a group are earlier names; threads and validation are of the whole process.
        if (option->get_group().empty() || name == "help" || name == "threads" || name == "validate")
            continue;
        found.push_back(
            {name, option->get_expected_max() == 0, option->get_type_name(), option->get_description()});
    }
    return found;
}

ParsedPicture parsePicture(const std::string& scene, std::vector<std::string> words) {
    CLI::App parser;
    const PictureOptions options(parser);
    std::reverse(words.begin(), words.end()); // the parser takes them from the end
    try {
        parser.parse(words);
    } catch (const CLI::ParseError& error) {
        throw UsageError(error.what());
    }
    ParsedPicture parsed{options.plan(scene), options.scene().importOptions()};
    // A host that embeds the module must not be ended: waits go on instead.
    parsed.plan.device.onKernelTimeout = {};
    return parsed;
}

} // namespace lavalight
