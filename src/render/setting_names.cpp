#include "render/setting_names.h"

#include <array>

namespace lavalight {
namespace {

constexpr std::array<SettingName<Sampler>, 2> kSamplers{
    {{"sobol", Sampler::sobol}, {"independent", Sampler::independent}}};
constexpr std::array<SettingName<Hemisphere>, 2> kHemispheres{
    {{"cosine", Hemisphere::cosine}, {"uniform", Hemisphere::uniform}}};
constexpr std::array<SettingName<LightSelection>, 4> kLightSelections{{{"auto", LightSelection::automatic},
                                                                       {"power", LightSelection::power},
                                                                       {"uniform", LightSelection::uniform},
                                                                       {"tree", LightSelection::tree}}};
constexpr std::array<SettingName<Mis>, 3> kMisKinds{
    {{"power", Mis::power}, {"balance", Mis::balance}, {"off", Mis::off}}};
constexpr std::array<SettingName<Roulette>, 6> kRoulettes{{{"sqrt-throughput", Roulette::sqrtThroughput},
                                                           {"throughput", Roulette::throughput},
                                                           {"off", Roulette::off},
                                                           {"constant", Roulette::constant},
                                                           {"mean-albedo", Roulette::meanAlbedo},
                                                           {"max-albedo", Roulette::maxAlbedo}}};
constexpr std::array<SettingName<Schedule>, 3> kSchedules{
    {{"auto", Schedule::automatic}, {"fused", Schedule::fused}, {"wavefront", Schedule::wavefront}}};
constexpr std::array<SettingName<Fresnel>, 2> kFresnels{
    {{"exact", Fresnel::exact}, {"schlick", Fresnel::schlick}}};
constexpr std::array<SettingName<TextureFilter>, 2> kTextureFilters{
    {{"bilinear", TextureFilter::bilinear}, {"stochastic", TextureFilter::stochastic}}};
constexpr std::array<SettingName<ToneCurve>, 4> kToneCurves{{{"linear", ToneCurve::linear},
                                                             {"neutral", ToneCurve::neutral},
                                                             {"agx", ToneCurve::agx},
                                                             {"aces", ToneCurve::aces}}};

} // namespace

template <>
std::span<const SettingName<Sampler>> settingNames() {
    return kSamplers;
}
template <>
std::span<const SettingName<Hemisphere>> settingNames() {
    return kHemispheres;
}
template <>
std::span<const SettingName<LightSelection>> settingNames() {
    return kLightSelections;
}
template <>
std::span<const SettingName<Mis>> settingNames() {
    return kMisKinds;
}
template <>
std::span<const SettingName<Roulette>> settingNames() {
    return kRoulettes;
}
template <>
std::span<const SettingName<Fresnel>> settingNames() {
    return kFresnels;
}
template <>
std::span<const SettingName<TextureFilter>> settingNames() {
    return kTextureFilters;
}
template <>
std::span<const SettingName<Schedule>> settingNames() {
    return kSchedules;
}
template <>
std::span<const SettingName<ToneCurve>> settingNames() {
    return kToneCurves;
}

} // namespace lavalight
