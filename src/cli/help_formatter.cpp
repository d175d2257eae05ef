#include "cli/help_formatter.h"

#include <set>

namespace lavalight {
namespace {

std::string namesOf(const char* label, const std::set<CLI::Option*>& options) {
    std::string text;
    for (const CLI::Option* option : options)
        text += " " + option->get_name();
    return text.empty() ? text : std::string(" ") + label + ":" + text;
}

} // namespace

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
    std::string text;
    if (option->get_type_size() != 0) { // not a flag
        if (!option->get_type_name().empty())
            text += " " + option->get_type_name();
        if (!option->get_default_str().empty())
            text += "=" + option->get_default_str();
        if (option->get_expected_max() == CLI::detail::expected_max_vector_size)
            text += " ...";
        if (option->get_required())
            text += " REQUIRED";
    }
    return text + namesOf("Needs", option->get_needs()) + namesOf("Excludes", option->get_excludes());
}

} // namespace lavalight
