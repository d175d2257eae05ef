// The search by name or number.
#include "base/named.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {

size_t findNamed(const std::vector<std::string>& names, const Wanted& wanted) {
    const auto found = std::find(names.begin(), names.end(), wanted.text);
    if (found != names.end())
        return static_cast<size_t>(found - names.begin());
    size_t number = 0;
    const char* last = wanted.text.data() + wanted.text.size();
    const auto [end, error] = std::from_chars(wanted.text.data(), last, number);
    if (!wanted.text.empty() && error == std::errc() && end == last && number < names.size())
        return number;
    std::string known = names.empty() ? "none" : "";
    for (size_t i = 0; i < names.size(); ++i)
        known += fmt::format("{}{} \"{}\"", i > 0 ? ", " : "", i, names[i]);
    throw UsageError(fmt::format("{}: {} has no {} \"{}\"; it has {}", wanted.option, wanted.owner,
                                 wanted.kind, wanted.text, known));
}

std::string textFor(const std::vector<std::string>& names, size_t index) {
    const auto here = names.begin() + static_cast<std::ptrdiff_t>(index);
    const bool isFound = !here->empty() && std::find(names.begin(), here, *here) == here;
    return isFound ? *here : std::to_string(index);
}

} // namespace lavalight
