// Rules for settings of the estimator that depend on each other.
#pragma once

#include "render/estimator_settings.h"

namespace lavalight {

// Throws UsageError, naming the options, where settings contradict each other.
void requireAgreement(const EstimatorSettings& settings);

// The settings, without what requireAgreement() would refuse.
[[nodiscard]] EstimatorSettings agreeing(EstimatorSettings settings);

} // namespace lavalight
