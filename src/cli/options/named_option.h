// Options whose values have names.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "render/setting_names.h"

namespace lavalight {

// An option whose value is one of these names, whatever their case. What the parser keeps is the word, so
// that it can be written again (cli/options/given_options.h).
template <typename Value>
CLI::Option* addOneOf(CLI::App& parser, const std::string& option, Value& value,
                      const std::map<std::string, Value>& values, const std::string& help) {
    std::vector<std::string> names;
    for (const auto& [name, ofName] : values)
        names.push_back(name);
    const auto check = [values, names](const std::string& text) {
        return values.contains(CLI::detail::to_lower(text))
                   ? std::string()
                   : fmt::format("{} not in {{{}}}", text, fmt::join(names, ","));
    };
    const auto take = [&value, values](const std::string& text) {
        value = values.at(CLI::detail::to_lower(text));
    };
    return parser.add_option_function<std::string>(option, take, help)->check(CLI::Validator(check, ""));
}

// An option for a setting with named values; its help and its errors list the names.
template <typename Value>
void addNamed(CLI::App& parser, const std::string& option, Value& value, const std::string& help) {
    std::map<std::string, Value> values;
    std::string names;
    for (const SettingName<Value>& name : settingNames<Value>()) {
        values.emplace(name.name, name.value);
        names += fmt::format("{}{}", names.empty() ? "" : "|", name.name);
    }
    addOneOf(parser, option, value, values, help)->type_name(names)->default_str(std::string(nameOf(value)));
}

} // namespace lavalight
