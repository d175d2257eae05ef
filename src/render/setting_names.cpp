#include "render/setting_names.h"

#include <array>

namespace lavalight {
namespace {

constexpr std::array<SettingName<Schedule>, 4> kSchedules{{{"auto", Schedule::automatic},
                                                           {"fused", Schedule::fused},
                                                           {"wavefront", Schedule::wavefront},
                                                           {"hosted", Schedule::hosted}}};
constexpr std::array<SettingName<ToneCurve>, 4> kToneCurves{{{"linear", ToneCurve::linear},
                                                             {"neutral", ToneCurve::neutral},
                                                             {"agx", ToneCurve::agx},
                                                             {"aces", ToneCurve::aces}}};

} // namespace

template <>
std::span<const SettingName<Schedule>> settingNames() {
    return kSchedules;
}
template <>
std::span<const SettingName<ToneCurve>> settingNames() {
    return kToneCurves;
}

} // namespace lavalight
