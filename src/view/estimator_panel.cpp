#include "view/estimator_panel.h"

#include <cmath>
#include <limits>
#include <string>

#include "render/presets.h"
#include "view/widgets.h"

namespace lavalight {
namespace {

bool drawPresets(EstimatorSettings& settings) {
    bool isChanged = false;
    if (ImGui::BeginCombo("preset", "a step of the lecture")) {
        for (const Preset& preset : presets()) {
            if (ImGui::Selectable(std::string(preset.name).c_str())) {
                const uint32_t seed = settings.seed;
                settings = preset.settings;
                settings.seed = seed;
                isChanged = true;
            }
            explain(std::string(preset.meaning).c_str());
        }
        ImGui::EndCombo();
    }
    explain("All settings at once, as one step of the lecture has them");
    return isChanged;
}

bool drawDirections(EstimatorSettings& e) {
    bool isChanged = choose("sampler", e.sampler,
                            "Where samples lie: Sobol's points fill each square evenly, independent ones "
                            "clump. Watch the noise of soft shadows");
    isChanged |= choose("hemisphere", e.hemisphere,
                        "Directions of diffuse surfaces. By the cosine: those that count more come more "
                        "often, and each path has the same weight");
    isChanged |= choose("fresnel", e.fresnel,
                        "How much glass reflects: exactly, or by Schlick's polynomial. They are two models: "
                        "the image itself changes a little");
    isChanged |= choose("texture filter", e.textureFilter,
                        "Between texels: the mean of four, or one of the four by chance, which has that "
                        "mean");
    isChanged |= tick("multiple scattering", e.multipleScattering,
                      "Rough metal returns what its facets send on to each other, which glTF's model loses");
    return isChanged;
}

bool drawLight(EstimatorSettings& e) {
    bool isChanged = tick("next-event estimation", e.nextEventEstimation,
                          "Every vertex asks a light whether it is seen. Off: paths find light only by "
                          "running into it, and small lights become noise");
    isChanged |= choose("light selection", e.lightSelection,
                        "Which light is asked: by its power, all alike, or by what it may bring to this "
                        "very point (a tree of lights)");
    isChanged |= choose("MIS", e.mis,
                        "A light found both by asking and by running into it is weighted by how likely each "
                        "was. Off: only one of the two counts, and mirrors of lamps get fireflies");
    return isChanged;
}

bool drawRoulette(EstimatorSettings& e) {
    bool isChanged = choose("roulette", e.roulette,
                            "A path that carries little is ended by chance; one that survives counts for "
                            "those that did not. The mean stays");
    isChanged |= count("from vertex", e.rouletteStart, 1, 64,
                       "The first vertex where a path may end so; what the camera sees first is vertex 1");
    if (e.roulette == Roulette::constant) {
        isChanged |= ImGui::SliderFloat("survival", &e.rouletteProbability, 0.05f, 1.0f, "%.2f",
                                        ImGuiSliderFlags_AlwaysClamp);
        explain("The probability to go on, whatever the path carries");
    }
    const bool isKnownBefore = e.roulette == Roulette::constant || e.roulette == Roulette::meanAlbedo ||
                               e.roulette == Roulette::maxAlbedo;
    if (isKnownBefore)
        isChanged |= tick("MIS counts survival", e.misSurvival,
                          "The density of a direction in MIS weights is multiplied by the probability that "
                          "the path lives to take it");
    else
        e.misSurvival = false; // it needs a probability that does not depend on the direction
    return isChanged;
}

bool drawLimits(EstimatorSettings& e) {
    bool isChanged = count("bounces at most", e.maxBounces, 0, 256,
                           "Scattering vertices of a path. 0 shows lamps alone, 1 direct light; a limit that "
                           "is reached takes light away");
    bool isClamped = !std::isinf(e.clampIndirect);
    if (tick("clamp indirect light", isClamped,
             "Takes the tops off fireflies, and light with them: the image is biased")) {
        e.clampIndirect = isClamped ? 10.0f : std::numeric_limits<float>::infinity();
        isChanged = true;
    }
    if (isClamped) {
        isChanged |= ImGui::DragFloat("at most", &e.clampIndirect, 0.1f, 0.01f, 1000.0f, "%.2f",
                                      ImGuiSliderFlags_AlwaysClamp);
        explain("The largest channel of what a path brings from beyond its first vertex");
    }
    isChanged |= count("seed", e.seed, 0, 1'000'000, "Another seed, other noise, the same mean");
    return isChanged;
}

} // namespace

bool drawEstimator(EstimatorSettings& settings) {
    bool isChanged = drawPresets(settings);
    isChanged |= drawDirections(settings);
    isChanged |= drawLight(settings);
    isChanged |= drawRoulette(settings);
    isChanged |= drawLimits(settings);
    return isChanged;
}

} // namespace lavalight
