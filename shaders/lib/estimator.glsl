// The estimator's settings that pick code, as specialisation constants; their values are named in shared/frame.h.
#include "shared/frame.h"

layout(constant_id = CONSTANT_SAMPLER) const uint kSampler = kSamplerSobol;
layout(constant_id = CONSTANT_HEMISPHERE) const uint kHemisphere = kHemisphereCosine;
layout(constant_id = CONSTANT_NEE) const uint kNee = 1u;
layout(constant_id = CONSTANT_MIS) const uint kMis = kMisPower;
layout(constant_id = CONSTANT_ROULETTE) const uint kRoulette = kRouletteCbrtThroughput;
layout(constant_id = CONSTANT_MIS_SURVIVAL) const uint kMisSurvival = 0u;
layout(constant_id = CONSTANT_FRESNEL) const uint kFresnel = kFresnelExact;
layout(constant_id = CONSTANT_MULTIPLE_SCATTERING) const uint kMultipleScattering = 0u;
layout(constant_id = CONSTANT_TEXTURE_FILTER) const uint kTextureFilter = kTextureFilterBilinear;
layout(constant_id = CONSTANT_SMOOTH_TERMINATOR) const uint kSmoothTerminator = 1u;
