#include "render/setting_rules.h"

#include <fmt/format.h>

#include "base/error.h"
#include "render/setting_names.h"
#include "render/setting_text.h"

namespace lavalight {
namespace {

bool isSurvivalUnknown(const EstimatorSettings& settings) {
    return settings.misSurvival && !rowOf("mis-survival").applies(settings);
}

} // namespace

void requireAgreement(const EstimatorSettings& settings) {
    if (isSurvivalUnknown(settings))
        throw UsageError(
            fmt::format("--mis-survival on needs a --roulette of constant, mean-albedo or max-albedo, whose "
                        "probability does not depend on the direction drawn; it is {}",
                        textOf(rowOf("roulette"), settings)));
}

void requireAgreement(Schedule schedule, RayAccelerator accelerator) {
    if (schedule == Schedule::automatic || accelerator == RayAccelerator::automatic)
        return;
    const bool isHosted = schedule == Schedule::hosted;
    if (isOnHost(accelerator) == isHosted)
        return;
    throw UsageError(fmt::format("cannot use the accelerator {} with the schedule {}: {}; try --schedule {}",
                                 nameOf(accelerator), nameOf(schedule),
                                 isHosted ? "the host traces its rays" : "kernels trace its rays",
                                 nameOf(isHosted ? Schedule::fused : Schedule::hosted)));
}

EstimatorSettings agreeing(EstimatorSettings settings) {
    if (isSurvivalUnknown(settings))
        settings.misSurvival = false;
    return settings;
}

} // namespace lavalight
