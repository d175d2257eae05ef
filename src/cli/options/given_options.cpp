#include "cli/options/given_options.h"

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {

std::vector<std::string> wordsGiven(const CLI::App& parser, const std::set<std::string>& except) {
    std::vector<std::string> words;
    for (const CLI::Option* option : parser.get_options()) {
        const std::string name = option->get_single_name();
        if (option->count() == 0 || except.contains(name))
            continue;
        const bool isFlag = option->get_expected_max() == 0;
        if (isFlag && !option->as<bool>()) // --flag=false
            continue;
        const bool hasValue = !isFlag && !option->results().front().empty();
        if (!isFlag && !hasValue && option->get_expected_min() > 0)
            throw UsageError(
                fmt::format("--{}: its value is empty; give one, or leave the option out", name));
        words.push_back(hasValue ? fmt::format("--{}={}", name, option->results().front())
                                 : fmt::format("--{}", name));
    }
    return words;
}

} // namespace lavalight
