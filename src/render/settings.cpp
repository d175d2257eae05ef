#include "render/settings.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/option_text.h"
#include "film/film_layout.h"
#include "render/pixel_filter.h"
#include "render/setting_names.h"
#include "render/setting_rules.h"
#include "render/setting_text.h"
#include "shared/film.h"

namespace lavalight {

PixelWindow windowOf(const ImageSettings& image) {
    return image.crop.value_or(PixelWindow{0, 0, image.width, image.height});
}

FilmPart partOf(const ImageSettings& image) {
    return {{image.width, image.height}, {windowOf(image)}};
}

void checkSettings(const RenderSettings& settings) {
    requireRange("--size (width)", settings.image.width, 1, kMaxImageSide);
    requireRange("--size (height)", settings.image.height, 1, kMaxImageSide);
    const PixelWindow window = windowOf(settings.image);
    if (window.right() > settings.image.width || window.bottom() > settings.image.height)
        throw UsageError(fmt::format("--crop: {} leaves the image of {}x{} pixels", textOf(window),
                                     settings.image.width, settings.image.height));
    requireRange("--spp", settings.stop.samples, 1, 0x7fffffff);
    if (settings.work.waveSize != 0)
        requireRange("--wave-size", settings.work.waveSize, 64, 4000000);
    requireRange("--time", settings.stop.seconds, 0, 1e9);
    requireRange("--target-error", settings.stop.targetError, 0, 1e9);
    if (!std::isfinite(settings.lighting.rotation))
        throw UsageError(
            fmt::format("--env-rotation: {} is not an angle in degrees", settings.lighting.rotation));
    requireRange("--env-intensity", settings.lighting.intensity, 0, 1e30);
    for (const SettingRow& row : settingRows())
        requireRange(row, settings.estimator);
    requireAgreement(settings.estimator);
    requireAgreement(settings.work.schedule, settings.work.accelerator);
}

namespace {

bool isForDenoising(uint32_t layers) {
    return (layers & kDenoisingLayers) == kDenoisingLayers;
}

} // namespace

uint32_t filmPlanes(const RenderSettings& settings) {
    const bool hasCoverage = settings.background.kind == Background::transparent;
    const bool catchesShadows = settings.ground.kind == Ground::shadow;
    uint32_t planes = settings.layers | 1u << kColorPlane | (hasCoverage ? 1u << kCoveragePlane : 0u) |
                      (catchesShadows ? 1u << kShadowPlane : 0u) |
                      (catchesShadows && !hasCoverage ? 1u << kBehindPlane : 0u);
    for (uint32_t row = 0; row < kFilmPlaneCount; ++row)
        if ((settings.layers >> row & 1u) != 0 && shapeOf(row, 0).isPerHit != 0)
            planes |= 1u << kHitsPlane;
    if ((settings.layers >> kIndirectPlane & 1u) != 0)
        planes |= 1u << kDirectPlane;
    if ((settings.layers & kCryptomatte) != 0)
        planes |= kObjectIds | kMaterialIds;
    return planes | (hasNegativeWeights(settings.estimator) ? kNegativeWeights : 0u);
}

OptionPairs describe(const RenderSettings& settings) {
    OptionPairs pairs;
    const auto add = [&](std::string_view option, auto value) {
        pairs.emplace_back(std::string(option), fmt::format("{}", value));
    };
    add("schedule", nameOf(settings.work.schedule));
    add("size", fmt::format("{}x{}", settings.image.width, settings.image.height));
    if (settings.image.crop)
        add("crop", textOf(*settings.image.crop));
    add("spp", settings.stop.samples);
    add("first-sample", settings.image.firstSample);
    add("time", settings.stop.seconds);
    add("target-error", settings.stop.targetError);
    for (const SettingRow& row : settingRows())
        if (row.decidesBits)
            add(row.name, textOf(row, settings.estimator));
    if (settings.lighting.constant)
        add("env", commaText(*settings.lighting.constant));
    if (!settings.lighting.mapFile.empty())
        add("env", settings.lighting.mapFile);
    if (settings.lighting.procedural != ProceduralEnvironment::none)
        add("env", nameOf(settings.lighting.procedural));
    if (settings.lighting.procedural == ProceduralEnvironment::sky) {
        add("sun-elevation", settings.lighting.sky.sunElevation);
        add("sun-azimuth", settings.lighting.sky.sunAzimuth);
        add("turbidity", settings.lighting.sky.turbidity);
    }
    if (settings.lighting.rotation != 0.0f || !settings.lighting.mapFile.empty())
        add("env-rotation", settings.lighting.rotation);
    add("env-intensity", settings.lighting.intensity);
    if (settings.background.kind == Background::transparent)
        add("background", "transparent");
    if (settings.background.kind == Background::constant)
        add("background", commaText(settings.background.radiance));
    if (settings.ground.kind == Ground::lambert)
        add("ground", fmt::format("#{:06x}", settings.ground.color));
    if (settings.ground.kind == Ground::shadow)
        add("ground", "shadow");
    // What is denoised may be asked for as a layer too, which changes no plane.
    const uint32_t asked =
        isForDenoising(settings.layers) ? settings.layers & ~kDenoisingLayers : settings.layers;
    if (asked != 0)
        add("aov", fmt::format("{}", fmt::join(layerNames(asked), ",")));
    if (isForDenoising(settings.layers))
        add("denoise", "on");
    if (!settings.provenance.changedShaders.empty())
        add("shaders", fmt::format("{}", fmt::join(settings.provenance.changedShaders, ",")));
    pairs.insert(pairs.end(), settings.provenance.cameraOptions.begin(),
                 settings.provenance.cameraOptions.end());
    return pairs;
}

} // namespace lavalight
