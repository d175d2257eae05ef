#include "cli/options/picture_options.h"

#include <memory>

namespace lavalight {

PictureOptions::PictureOptions(CLI::App& parser)
    : options_(parser), crop_(parser), scene_(parser), tone_(parser), background_(parser), ground_(parser),
      layers_(parser),
      denoise_(parser, {"Denoise the PNG, by Intel Open Image Denoise; the EXR keeps its colour and gets a "
                        "layer denoised. Without a word: high",
                        DenoiseQuality::high}) {}

RenderPlan PictureOptions::plan(const std::string& scene) const {
    RenderPlan plan = options_.plan(scene);
    plan.settings.background = background_.settings();
    plan.settings.ground = ground_.settings();
    plan.settings.layers = layers_.layers();
    plan.settings.image.crop = crop_.window();
    plan.style = {options_.keepsFilm() || plan.settings.image.crop, tone_.settings(), tone_.isAutomatic()};
    plan.style.tone.backdrop = background_.backdrop();
    plan.style.layers = plan.settings.layers;
    if (const std::optional<DenoiseQuality> quality = denoise_.quality()) {
        plan.style.quality = *quality;
        plan.style.denoiser = std::make_shared<const Denoiser>();
        plan.settings.layers |= kDenoisingLayers;
    }
    return plan;
}

} // namespace lavalight
