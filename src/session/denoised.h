// The denoised picture of a render.
#pragma once

#include "denoise/denoiser.h"
#include "image/rendering.h"
#include "render/settings.h"

namespace lavalight {

// The layer that denoise() adds.
inline constexpr const char* kDenoisedLayer = "denoised";

// Planes that denoise() reads (RenderSettings::layers).
[[nodiscard]] uint32_t layersForDenoising();

// Adds the layer kDenoisedLayer. Light that is seen directly is left as it is: it has no noise but at its
// edges, and a lamp among dark walls would come out too bright. Takes out the layers that no one asked for
// (`asked`: RenderSettings::layers). Throws Error as the library does.
void denoise(Rendering& rendering, const Denoiser& denoiser, DenoiseQuality quality, uint32_t asked);

} // namespace lavalight
