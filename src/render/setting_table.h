// The estimator's settings as one table. Whatever lists settings loops over it: the command line, the panel,
// the image's header, specialisation of kernels, the documentation, tests of the mean.
//
// A new setting is three things: its constant in shaders/shared/frame.h, its member of EstimatorSettings, its
// row in setting_table.cpp. A member without a row does not compile.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "render/estimator_settings.h"
#include "render/setting_names.h"

namespace lavalight {

// A setting with few values, each of which has a name: an enumeration, or on and off.
struct NamedValues {
    std::span<const SettingName<uint32_t>> names; // the default first
    uint32_t (*get)(const EstimatorSettings& settings);
    void (*set)(EstimatorSettings& settings, uint32_t value); // `value` is one that has a name
    // Constant in shaders/shared/frame.h: kernels are specialised by the value.
    std::optional<uint32_t> constant;
    bool isSwitch; // on or off, which is 1 or 0
};

struct WholeNumber {
    uint32_t EstimatorSettings::*member;
    uint32_t least;
    uint32_t most;
    uint32_t mostShown; // largest value in the panel, whose mouse is not a keyboard
};

// A number above 0.
struct PositiveNumber {
    float EstimatorSettings::*member;
    float most; // infinite: no limit
    // The range of the panel.
    float leastShown;
    float mostShown;
    std::string_view infinite{}; // the name of infinity; empty: it has none
    float firstFinite = 1.0f;    // value that the panel starts from when infinity is left
};

struct SettingRow {
    std::string_view name; // the option's name, without dashes
    std::variant<NamedValues, WholeNumber, PositiveNumber> values;
    bool decidesBits; // whether the image's bits depend on it: a film with another value is of another image
    bool mayChangeMean;          // if not, all values have one mean, which the tests hold
    std::string_view help;       // one sentence: what the setting does
    std::string_view panelLabel; // the setting's name in the panel
    std::string_view panelHelp;  // one sentence for who points at it
    // Whether the setting plays a part beside the others.
    bool (*applies)(const EstimatorSettings& settings) = [](const EstimatorSettings&) { return true; };
};

// One row for each member of EstimatorSettings.
[[nodiscard]] std::span<const SettingRow> settingRows();

// The row of an option, which must be one of the table.
[[nodiscard]] const SettingRow& rowOf(std::string_view name);

// Whether the two have one value of this setting.
[[nodiscard]] bool haveSameValue(const SettingRow& row, const EstimatorSettings& a,
                                 const EstimatorSettings& b);

} // namespace lavalight
