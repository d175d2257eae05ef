#include "render/setting_text.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <variant>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parse.h"

namespace lavalight {
namespace {

using Name = SettingName<uint32_t>;

std::string joined(const NamedValues& values, std::string_view separator) {
    std::string text;
    for (const Name& name : values.names)
        text += fmt::format("{}{}", text.empty() ? "" : separator, name.name);
    return text;
}

std::string inLowerCase(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return lower;
}

// Sets the value of a text; false where it has none.
struct Setter {
    EstimatorSettings& settings;
    std::string text;

    bool operator()(const NamedValues& values) const {
        const auto found = std::find_if(values.names.begin(), values.names.end(),
                                        [&](const Name& name) { return name.name == text; });
        if (found == values.names.end())
            return false;
        values.set(settings, found->value);
        return true;
    }
    bool operator()(const WholeNumber& number) const {
        const auto value = parseNumber<uint32_t>(text);
        settings.*number.member = value.value_or(settings.*number.member);
        return value.has_value();
    }
    bool operator()(const PositiveNumber& number) const {
        const bool isInfinite = !number.infinite.empty() && text == number.infinite;
        const auto value = isInfinite ? std::numeric_limits<float>::infinity() : parseNumber<float>(text);
        settings.*number.member = value.value_or(settings.*number.member);
        return value.has_value();
    }
};

// What a value may be, in the words of a message.
struct Wants {
    std::string operator()(const NamedValues& values) const { return "one of " + joined(values, ", "); }
    std::string operator()(const WholeNumber& number) const {
        return fmt::format("a whole number from {} to {}", number.least, number.most);
    }
    std::string operator()(const PositiveNumber& number) const {
        const std::string most = std::isinf(number.most) ? "" : fmt::format(" up to {}", number.most);
        const std::string other = number.infinite.empty() ? "" : fmt::format("{} or ", number.infinite);
        return fmt::format("{}a number above 0{}", other, most);
    }
};

struct Names {
    std::string operator()(const NamedValues& values) const { return joined(values, "|"); }
    std::string operator()(const WholeNumber&) const { return "N"; }
    std::string operator()(const PositiveNumber& number) const {
        return number.infinite.empty() ? "X" : fmt::format("{}|X", number.infinite);
    }
};

struct Text {
    const EstimatorSettings& settings;

    std::string operator()(const NamedValues& values) const {
        const uint32_t value = values.get(settings);
        const auto found = std::find_if(values.names.begin(), values.names.end(),
                                        [&](const Name& name) { return name.value == value; });
        assert(found != values.names.end());
        return std::string(found->name);
    }
    std::string operator()(const WholeNumber& number) const {
        return fmt::format("{}", settings.*number.member);
    }
    std::string operator()(const PositiveNumber& number) const {
        const float value = settings.*number.member;
        return std::isinf(value) && !number.infinite.empty() ? std::string(number.infinite)
                                                             : fmt::format("{}", value);
    }
};

struct InRange {
    const EstimatorSettings& settings;

    bool operator()(const NamedValues&) const { return true; } // set() knows no other
    bool operator()(const WholeNumber& number) const {
        const uint32_t value = settings.*number.member;
        return value >= number.least && value <= number.most;
    }
    bool operator()(const PositiveNumber& number) const {
        const float value = settings.*number.member;
        return value > 0.0f && value <= number.most; // false for NaN, too
    }
};

struct Range {
    std::string operator()(const NamedValues& values) const { return joined(values, ", "); }
    std::string operator()(const WholeNumber& number) const {
        return fmt::format("{} to {}", number.least, number.most);
    }
    std::string operator()(const PositiveNumber& number) const {
        return std::isinf(number.most) ? "above 0" : fmt::format("above 0 to {}", number.most);
    }
};

} // namespace

std::string valueNames(const SettingRow& row) {
    return std::visit(Names{}, row.values);
}

std::string textOf(const SettingRow& row, const EstimatorSettings& settings) {
    return std::visit(Text{settings}, row.values);
}

void setText(const SettingRow& row, EstimatorSettings& settings, std::string_view text) {
    if (!std::visit(Setter{settings, inLowerCase(text)}, row.values))
        throw UsageError(
            fmt::format("--{}: \"{}\" is not {}", row.name, text, std::visit(Wants{}, row.values)));
}

void requireRange(const SettingRow& row, const EstimatorSettings& settings) {
    if (!std::visit(InRange{settings}, row.values))
        throw UsageError(
            fmt::format("--{}: {} is outside the range {}", row.name, textOf(row, settings), rangeOf(row)));
}

std::string rangeOf(const SettingRow& row) {
    return std::visit(Range{}, row.values);
}

std::string optionsFrom(const EstimatorSettings& base, const EstimatorSettings& settings) {
    std::string text;
    for (const SettingRow& row : settingRows())
        if (!haveSameValue(row, base, settings))
            text += fmt::format("{}--{} {}", text.empty() ? "" : " ", row.name, textOf(row, settings));
    return text;
}

} // namespace lavalight
