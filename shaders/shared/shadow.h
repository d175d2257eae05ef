// The shadow of a pixel, from the sums of kShadowPlane.
#ifndef LAVALIGHT_SHARED_SHADOW_H
#define LAVALIGHT_SHARED_SHADOW_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// The share of light that something keeps from the ground; 0 where there is no light. `lit` and `visible` are sums over the
// same samples, or their means. A ratio of two sums is consistent, not unbiased. Negative weights of a pixel filter may lead
// out of [0, 1] where there are few samples.
SHARED_FUNCTION float shadowOf(float lit, float visible) {
    return lit > 0.0f && visible < lit ? (visible > 0.0f ? 1.0f - visible / lit : 1.0f) : 0.0f;
}

LAVALIGHT_SHARED_END

#endif
