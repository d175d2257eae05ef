// The estimator's settings, to be changed while it runs.
#pragma once

#include "render/settings.h"

namespace lavalight {

// Draws them with what each means. Settings that contradict each other are made to agree. Whether any was
// changed.
bool drawEstimator(EstimatorSettings& settings);

} // namespace lavalight
