#include "session/ledger.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lavalight {

std::vector<LedgerEntry> makeLedger(const Scene& scene, const RenderSettings& settings,
                                    const FilmTallies& tallies, StopReason stop) {
    std::vector<LedgerEntry> ledger;
    const EstimatorSettings& estimator = settings.estimator;
    if (!settings.provenance.changedShaders.empty())
        ledger.push_back(
            {"changed-shaders", fmt::format("{}", fmt::join(settings.provenance.changedShaders, ", "))});
    if (std::isfinite(estimator.clampIndirect))
        ledger.push_back(
            {"clamp-indirect", fmt::format("indirect light was limited to {}", estimator.clampIndirect)});
    if (!estimator.nextEventEstimation && !scene.punctualLights.empty())
        ledger.push_back({"unreachable-lights", fmt::format("--nee off cannot find {} lights without size",
                                                            scene.punctualLights.size())});
    if (settings.ground.kind == Ground::shadow)
        ledger.push_back({"shadow-catcher", "the shadow on the ground is a ratio of two sums, which tends to "
                                            "its mean as samples are added"});
    if (stop == StopReason::targetError)
        ledger.push_back(
            {"stopped-on-estimate", fmt::format("the error estimate reached {}", settings.stop.targetError)});
    if (scene.hasStandInLight)
        ledger.push_back(
            {"stand-in-light", fmt::format("{}: the scene has no light", scene.environmentMap->source)});
    if (scene.environmentMap && scene.environmentMap->badTexels > 0)
        ledger.push_back(
            {"environment-values",
             fmt::format("{} texels of the environment map were negative or not finite, and are 0",
                         scene.environmentMap->badTexels)});
    if (scene.coarse)
        ledger.push_back({"coarse-geometry",
                          fmt::format("positions {:.3g} m from the scene's origin are rounded to steps of "
                                      "{:.3g} m, where something is {:.3g} m wide",
                                      scene.coarse->distance, scene.coarse->resolution, scene.coarse->size)});
    if (!scene.ignoredExtensions.empty())
        ledger.push_back({"ignored-extensions", fmt::format("{}", fmt::join(scene.ignoredExtensions, ", "))});
    if (!scene.openSolids.empty())
        ledger.push_back({"open-solids", fmt::format("{} (KHR_materials_volume) bound no body",
                                                     fmt::join(scene.openSolids, ", "))});
    for (LedgerEntry& entry : tallyEntries(tallies))
        ledger.push_back(std::move(entry));
    return ledger;
}

namespace {

std::string nameOfSolid(const Scene& scene, uint32_t number) {
    return number > 0 && number < kUnnamedSolid && number <= scene.solids.size()
               ? fmt::format("\"{}\"", scene.meshes[scene.solids[number - 1].mesh].name)
               : "a mesh";
}

} // namespace

std::string crowdedText(const Scene& scene, const FilmTallies& tallies) {
    return fmt::format(
        "{} lies within more than {} solids at once (KHR_materials_volume), where {} paths did "
        "not know their medium; let fewer solids overlap",
        nameOfSolid(scene, tallies.crowdedSolid), kMostNestedSolids, tallies.crowdedPaths);
}

} // namespace lavalight
