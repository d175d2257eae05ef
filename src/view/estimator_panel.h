// The estimator's settings, to be changed while it runs.
#pragma once

#include "render/settings.h"

namespace lavalight {

// Draws the settings with what each means and makes those agree that contradict each other. Returns whether
// any was changed.
bool drawEstimator(EstimatorSettings& settings);

} // namespace lavalight
