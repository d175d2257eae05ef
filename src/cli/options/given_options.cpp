#include "cli/options/given_options.h"

#include <fmt/format.h>

namespace lavalight {

std::vector<std::string> wordsGiven(const CLI::App& parser, const std::set<std::string>& except) {
    std::vector<std::string> words;
    for (const CLI::Option* option : parser.get_options()) {
        const std::string name = option->get_single_name();
        if (option->count() == 0 || except.contains(name))
            continue;
        const std::string word = "--" + name;
        const bool hasValue = option->get_expected_max() > 0 && !option->results().front().empty();
        if (!hasValue) {
            words.push_back(word);
        } else if (option->get_expected_min() == 0 || option->results().front().starts_with('-')) {
            words.push_back(fmt::format(
                "{}={}", word, option->results().front())); // a word of its own could mean something else
        } else {
            words.insert(words.end(), {word, option->results().front()});
        }
    }
    return words;
}

} // namespace lavalight
