// The words of the command line for values of enumerations.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "render/settings.h"
#include "render/tone_settings.h"
#include "scene/framing_camera.h"

namespace lavalight {

template <typename Value>
struct SettingName {
    std::string_view name;
    Value value;
};

// All values of a setting with their names, the default first. One specialisation per enumeration.
template <typename Value>
[[nodiscard]] std::span<const SettingName<Value>> settingNames();

template <>
std::span<const SettingName<Schedule>> settingNames();
template <>
std::span<const SettingName<RayAccelerator>> settingNames();
template <>
std::span<const SettingName<ToneCurve>> settingNames();
template <>
std::span<const SettingName<ProceduralEnvironment>> settingNames();
template <>
std::span<const SettingName<NamedView>> settingNames();

template <typename Value>
[[nodiscard]] std::string_view nameOf(Value value) {
    const auto names = settingNames<Value>();
    return std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.value == value; })->name;
}

} // namespace lavalight
