// Rules for settings that depend on each other.
#pragma once

#include "render/estimator_settings.h"
#include "render/settings.h"

namespace lavalight {

// Throws UsageError, naming the options, where settings contradict each other.
void requireAgreement(const EstimatorSettings& settings);
void requireAgreement(Schedule schedule, RayAccelerator accelerator);

// The settings, without what requireAgreement() would refuse.
[[nodiscard]] EstimatorSettings agreeing(EstimatorSettings settings);

} // namespace lavalight
