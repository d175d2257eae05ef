// Values of settings as text, in the words of the command line.
#pragma once

#include <string>
#include <string_view>

#include "render/setting_table.h"

namespace lavalight {

// What the command line takes: "power|balance|off", "N", "off|X".
[[nodiscard]] std::string valueNames(const SettingRow& row);

// The value in the words of the command line.
[[nodiscard]] std::string textOf(const SettingRow& row, const EstimatorSettings& settings);

// Sets the value of that text; names may be in capitals. Throws UsageError, naming the option and what it
// takes, for text that is no value; whether a number is in range is left to requireRange().
void setText(const SettingRow& row, EstimatorSettings& settings, std::string_view text);

// "0 to 1024", "above 0".
[[nodiscard]] std::string rangeOf(const SettingRow& row);

// Throws UsageError, naming the option and its range.
void requireRange(const SettingRow& row, const EstimatorSettings& settings);

// The options that make `settings` of `base`: "--nee on --mis off"; empty where they are equal.
[[nodiscard]] std::string optionsFrom(const EstimatorSettings& base, const EstimatorSettings& settings);

} // namespace lavalight
