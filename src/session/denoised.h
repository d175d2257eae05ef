// The denoised picture of a render.
#pragma once

#include "denoise/denoiser.h"
#include "image/rendering.h"
#include "render/settings.h"

namespace lavalight {

// The layer that denoise() adds.
inline constexpr const char* kDenoisedLayer = "denoised";
// The coverage that it is associated with, where the rendering has coverage.
inline constexpr const char* kDenoisedCoverage = "denoised.A";
// The part of it that is shadow, where the ground catches shadows.
inline constexpr const char* kDenoisedShadow = "denoised-shadow";

// Adds the layer kDenoisedLayer to a rendering that has kDenoisingLayers. Where the image `isSharp`, seen
// through a pinhole, light that is seen directly is left as it is: it has no noise but at its edges, and a
// lamp among dark walls would come out too bright. Where there is a layer of coverage, it is
// denoised too (kDenoisedCoverage), and colour is denoised as if all were covered. So are the shadows that
// the ground caught, as a share of the light there, whatever is seen through them (kDenoisedShadow). Takes
// out the layers that no one asked for (`asked`: RenderSettings::layers). False, with the rendering as it
// was, where `keepGoing` gave it up. Throws Error as the library does.
bool denoise(Rendering& rendering, const Denoiser& denoiser, DenoiseQuality quality, uint32_t asked,
             bool isSharp, const KeepGoing& keepGoing = {});

// Takes out the layers that denoise() reads and no one asked for.
void removeGuides(Rendering& rendering, uint32_t asked);

} // namespace lavalight
