#include "render/setting_rules.h"

#include <fmt/format.h>

#include "base/error.h"
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

EstimatorSettings agreeing(EstimatorSettings settings) {
    if (isSurvivalUnknown(settings))
        settings.misSurvival = false;
    return settings;
}

} // namespace lavalight
