// The table of settings: its names, defaults and ranges, and values as text.
#include "render/setting_text.h"

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "render/setting_rules.h"
#include "render/settings.h"
#include "support/changed_setting.h"

namespace lavalight {
namespace {

using test::withAnother;

// What setting that text says; empty if it is taken.
std::string complaint(const SettingRow& row, const std::string& text) {
    EstimatorSettings settings;
    try {
        setText(row, settings, text);
        requireRange(row, settings);
    } catch (const UsageError& error) {
        return error.what();
    }
    return {};
}

TEST(SettingTable, NamesOfOptionsAndLabelsAreOneOfAKind) {
    std::set<std::string_view> names;
    std::set<std::string_view> labels;
    for (const SettingRow& row : settingRows()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_TRUE(labels.insert(row.panelLabel).second) << row.panelLabel;
        EXPECT_EQ(&rowOf(row.name), &row);
        EXPECT_FALSE(row.help.empty() || row.panelHelp.empty()) << row.name;
    }
}

TEST(SettingTable, DefaultsAreInRangeAndTheFirstOfTheNamedValues) {
    const EstimatorSettings defaults;
    for (const SettingRow& row : settingRows()) {
        EXPECT_NO_THROW(requireRange(row, defaults)) << row.name;
        if (const auto* values = std::get_if<NamedValues>(&row.values)) {
            EXPECT_EQ(values->names.front().value, values->get(defaults)) << row.name;
        }
    }
}

TEST(SettingTable, NamedValuesAreOneOfAKind) {
    for (const SettingRow& row : settingRows()) {
        const auto* values = std::get_if<NamedValues>(&row.values);
        if (values == nullptr)
            continue;
        std::map<std::string_view, uint32_t> byName;
        std::set<uint32_t> all;
        for (const auto& [name, value] : values->names) {
            EXPECT_TRUE(byName.emplace(name, value).second) << row.name << " " << name;
            EXPECT_TRUE(all.insert(value).second) << row.name << " " << name;
        }
    }
}

// Sets a value by its text and asks for its text again.
void expectRoundTrip(const SettingRow& row, const EstimatorSettings& wanted) {
    const std::string text = textOf(row, wanted);
    EstimatorSettings settings = withAnother(row);
    setText(row, settings, text);
    EXPECT_TRUE(haveSameValue(row, settings, wanted)) << row.name << " " << text;
    EXPECT_EQ(textOf(row, settings), text) << row.name;
}

TEST(SettingTable, EveryValueComesBackFromItsText) {
    for (const SettingRow& row : settingRows()) {
        expectRoundTrip(row, {});
        expectRoundTrip(row, withAnother(row));
        EstimatorSettings settings;
        if (const auto* values = std::get_if<NamedValues>(&row.values)) {
            for (const auto& [name, value] : values->names) {
                values->set(settings, value);
                EXPECT_EQ(textOf(row, settings), name);
                expectRoundTrip(row, settings);
            }
        } else if (const auto* number = std::get_if<WholeNumber>(&row.values)) {
            for (const uint32_t value : {number->least, number->most}) {
                settings.*number->member = value;
                expectRoundTrip(row, settings);
            }
        } else {
            settings.*std::get<PositiveNumber>(row.values).member = 0.1f; // which no decimal equals
            expectRoundTrip(row, settings);
        }
    }
}

TEST(SettingTable, NamesMayBeInCapitalsAndTheirNumbersAreNoNames) {
    EXPECT_EQ(complaint(rowOf("mis"), "BALANCE"), "");
    EXPECT_EQ(complaint(rowOf("mis"), "1"), "--mis: \"1\" is not one of power, balance, off");
    EXPECT_EQ(complaint(rowOf("nee"), "true"), "--nee: \"true\" is not one of on, off");
}

TEST(SettingTable, WhatIsNoNumberOrOutOfRangeIsRefusedByItsOptionsName) {
    const SettingRow& bounces = rowOf("max-bounces");
    const SettingRow& clamp = rowOf("clamp-indirect");
    EXPECT_EQ(complaint(bounces, "many"), "--max-bounces: \"many\" is not a whole number from 0 to 1024");
    EXPECT_EQ(complaint(bounces, "1025"), "--max-bounces: 1025 is outside the range 0 to 1024");
    EXPECT_EQ(complaint(clamp, "bright"), "--clamp-indirect: \"bright\" is not off or a number above 0");
    for (const SettingRow& row : settingRows()) {
        for (const char* text : {"", " ", "-1", "1.5.", "0x", "1e99", "nan", "value"}) {
            EXPECT_TRUE(complaint(row, text).starts_with("--" + std::string(row.name)))
                << row.name << " " << text;
        }
    }
    EXPECT_NE(complaint(rowOf("seed"), "4294967296"), "");
    EXPECT_NE(complaint(rowOf("roulette-probability"), "0"), "");
    EXPECT_NE(complaint(rowOf("roulette-probability"), "off"), "") << "it has no name for infinity";
    EXPECT_NE(complaint(rowOf("roulette-probability"), "inf"), "");
    EXPECT_EQ(complaint(clamp, "off"), "");
}

// What the header names decides what may be merged.
TEST(SettingTable, DescriptionHasEverySettingThatDecidesBits) {
    for (const SettingRow& row : settingRows()) {
        RenderSettings settings;
        settings.estimator = withAnother(row);
        const OptionPairs pairs = describe(settings);
        const std::pair<std::string, std::string> wanted(row.name, textOf(row, settings.estimator));
        EXPECT_EQ(std::count(pairs.begin(), pairs.end(), wanted), row.decidesBits ? 1 : 0) << row.name;
    }
}

TEST(SettingTable, OptionsAreThoseThatDiffer) {
    EstimatorSettings settings;
    EXPECT_EQ(optionsFrom({}, settings), "");
    settings.mis = Mis::off;
    settings.clampIndirect = 2.5f;
    EXPECT_EQ(optionsFrom({}, settings), "--mis off --clamp-indirect 2.5");
    EXPECT_EQ(optionsFrom(settings, {}), "--mis power --clamp-indirect off");
}

// Settings that contradict each other at every combination of two values.
TEST(SettingTable, AgreeingSettingsAreAccepted) {
    RenderSettings settings;
    settings.image.width = 1;
    for (const SettingRow& row : settingRows()) {
        for (const SettingRow& other : settingRows()) {
            settings.estimator = withAnother(row);
            setText(other, settings.estimator, textOf(other, withAnother(other)));
            settings.estimator = agreeing(settings.estimator);
            EXPECT_NO_THROW(checkSettings(settings)) << row.name << ", " << other.name;
        }
    }
    settings.estimator = EstimatorSettings{};
    settings.estimator.misSurvival = true;
    settings.estimator.roulette = Roulette::constant;
    EXPECT_EQ(agreeing(settings.estimator), settings.estimator);
}

} // namespace
} // namespace lavalight
