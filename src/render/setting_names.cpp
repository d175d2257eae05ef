#include "render/setting_names.h"

#include <array>

namespace lavalight {
namespace {

constexpr std::array<SettingName<Schedule>, 4> kSchedules{{{"auto", Schedule::automatic},
                                                           {"fused", Schedule::fused},
                                                           {"wavefront", Schedule::wavefront},
                                                           {"hosted", Schedule::hosted}}};
constexpr std::array<SettingName<RayAccelerator>, 5> kAccelerators{{{"auto", RayAccelerator::automatic},
                                                                    {"bvh8", RayAccelerator::bvh8},
                                                                    {"bvh16", RayAccelerator::bvh16},
                                                                    {"embree", RayAccelerator::embree},
                                                                    {"ray-query", RayAccelerator::rayQuery}}};
constexpr std::array<SettingName<ToneCurve>, 4> kToneCurves{{{"neutral", ToneCurve::neutral},
                                                             {"linear", ToneCurve::linear},
                                                             {"agx", ToneCurve::agx},
                                                             {"aces", ToneCurve::aces}}};
constexpr std::array<SettingName<ProceduralEnvironment>, 3> kEnvironments{
    {{"none", ProceduralEnvironment::none},
     {"studio", ProceduralEnvironment::studio},
     {"sky", ProceduralEnvironment::sky}}};
constexpr std::array<SettingName<NamedView>, 8> kViews{{{"none", NamedView::none},
                                                        {"front", NamedView::front},
                                                        {"back", NamedView::back},
                                                        {"left", NamedView::left},
                                                        {"right", NamedView::right},
                                                        {"top", NamedView::top},
                                                        {"bottom", NamedView::bottom},
                                                        {"three-quarter", NamedView::threeQuarter}}};

} // namespace

template <>
std::span<const SettingName<Schedule>> settingNames() {
    return kSchedules;
}
template <>
std::span<const SettingName<RayAccelerator>> settingNames() {
    return kAccelerators;
}
template <>
std::span<const SettingName<ToneCurve>> settingNames() {
    return kToneCurves;
}
template <>
std::span<const SettingName<ProceduralEnvironment>> settingNames() {
    return kEnvironments;
}
template <>
std::span<const SettingName<NamedView>> settingNames() {
    return kViews;
}

} // namespace lavalight
