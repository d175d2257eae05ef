// Planes of records that a scene needs (shaders/shared/records.h).
#pragma once

#include <cstdint>

#include "shared/features.h"
#include "shared/records.h"

namespace lavalight {

// kRecord... bits.
[[nodiscard]] constexpr uint32_t recordPlanes(SceneFeatures features) {
    constexpr SceneFeatures kTwoSided = kFeatureGlass | kFeatureDiffuseTransmission;
    const auto has = [&](SceneFeatures any) { return (features & any) != 0; };
    return (has(kTwoSided | kFeatureLightTree) ? kRecordState : 0u) |
           (has(kTwoSided | kFeatureSolids) ? kRecordShadowOrigin : 0u) |
           (has(kFeatureSolids) ? kRecordInterior : 0u);
}

} // namespace lavalight
