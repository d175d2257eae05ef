// The words of the command line for qualities of denoising.
#pragma once

#include "denoise/denoiser.h"
#include "render/setting_names.h"

namespace lavalight {

template <>
std::span<const SettingName<DenoiseQuality>> settingNames();

} // namespace lavalight
