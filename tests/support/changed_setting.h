// Settings that differ from the defaults in one row of the table.
#pragma once

#include <variant>

#include "render/setting_table.h"

namespace lavalight::test {

// The defaults with another value of that setting.
inline EstimatorSettings withAnother(const SettingRow& row) {
    EstimatorSettings settings;
    if (const auto* values = std::get_if<NamedValues>(&row.values))
        values->set(settings, values->names.back().value);
    else if (const auto* number = std::get_if<WholeNumber>(&row.values))
        ++(settings.*number->member);
    else
        settings.*std::get<PositiveNumber>(row.values).member = 0.25f;
    return settings;
}

} // namespace lavalight::test
