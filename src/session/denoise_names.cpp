#include "session/denoise_names.h"

#include <array>

namespace lavalight {
namespace {

constexpr std::array<SettingName<DenoiseQuality>, 3> kQualities{
    {{"high", DenoiseQuality::high}, {"balanced", DenoiseQuality::balanced}, {"fast", DenoiseQuality::fast}}};

} // namespace

template <>
std::span<const SettingName<DenoiseQuality>> settingNames() {
    return kQualities;
}

} // namespace lavalight
