#include "cli/options/given_options.h"

#include <fmt/format.h>

namespace lavalight {

std::vector<std::string> wordsGiven(const CLI::App& parser, const std::set<std::string>& except) {
    std::vector<std::string> words;
    for (const CLI::Option* option : parser.get_options()) {
        const std::string name = option->get_single_name();
        if (option->count() == 0 || except.contains(name))
            continue;
        const bool hasValue = option->get_expected_max() > 0 && !option->results().front().empty();
        words.push_back(hasValue ? fmt::format("--{}={}", name, option->results().front())
                                 : fmt::format("--{}", name));
    }
    return words;
}

} // namespace lavalight
