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

// A validator that takes one of the names, whatever their case, and hands on the value's number, which is
// what the parser stores.
template <typename Value>
[[nodiscard]] CLI::Validator oneOf(const std::map<std::string, Value>& values) {
    std::vector<std::string> names;
    for (const auto& [name, value] : values)
        names.push_back(name);
    const auto replaceName = [values, names](std::string& text) -> std::string {
        const auto found = values.find(CLI::detail::to_lower(text));
        if (found == values.end())
            return fmt::format("{} not in {{{}}}", text, fmt::join(names, ","));
        text = std::to_string(static_cast<uint32_t>(found->second));
        return {};
    };
    return {replaceName, ""};
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
    parser.add_option(option, value, help)
        ->type_name(names)
        ->transform(oneOf(values))
        ->default_str(std::string(nameOf(value)));
}

} // namespace lavalight
