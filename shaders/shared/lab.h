// What the kernels of the lab and the host agree on: a run of an estimator, and what it leaves behind.
#ifndef LAVALIGHT_SHARED_LAB_H
#define LAVALIGHT_SHARED_LAB_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// Bindings of descriptor set 0 of these kernels, which share no buffer with the renderer.
#define BINDING_LAB_OUT 0
#define BINDING_LAB_TABLE 1

// One run of an estimator. Invocation i takes samples of stream i / blocks: the numbers of a stream are one sequence, cut
// into blocks so that sums of floats stay short.
struct LabRun {
    uint seed;
    uint sampleCount; // samples of all invocations; the last one may have fewer than samplesEach
    uint samplesEach; // samples of one invocation
    uint blocks;      // invocations to a stream
    uint kind;        // which estimator: the constants below, by kernel
    uint variant;     // which integrand, where there are several
    uint count;       // strata, rays
    uint first;       // the first invocation of this dispatch, when a run has several
    vec4 a; // what the estimator asks for
    vec4 b;
};

// Mean and sum of squared differences from the mean of `count` samples.
struct LabMoments {
    float mean;
    float squares;
    uint count;
};

// lab_dice: 6 * D1 + D2
SHARED_CONST uint kDiceTogether = 0u;
SHARED_CONST uint kDieAtATime = 1u; // a.x: probability of rolling the sixfold die

// lab_strata: integral of exp(kStrataRate x) over [0, 1]
SHARED_CONST uint kStrataPicked = 0u; // one of `count` strata by the probabilities of the table
SHARED_CONST uint kStrataEach = 1u;   // one point in each of `count` strata; the sample is their mean
SHARED_CONST uint kStrataPdf = 2u;    // infinitely many strata: a density proportional to the integrand
SHARED_CONST float kStrataRate = 4.0f;

// lab_hemisphere: irradiance; kind is one of kHemisphere... of shared/frame.h
SHARED_CONST uint kSkyConstant = 0u; // radiance 1
SHARED_CONST uint kSkyOvercast = 1u; // radiance (1 + 2 sin(elevation)) / 3: 1 at the zenith, a third at the horizon

// lab_lights: a and b are two spheres seen from a floor: cosine of the angle between centre and normal, 1 - cosine of the
// half-angle, radiance, probability of being picked

// lab_roulette: `count` rays of a.x W; each goes on with probability a.y
SHARED_CONST uint kRouletteMadeUp = 0u;  // survivors are divided by that probability
SHARED_CONST uint kRouletteForgot = 1u; // survivors are left as they are: wrong

// lab_fresnel: reflectance averaged over a cosine-weighted hemisphere; kind is one of kFresnel... of shared/frame.h,
// a.x the index beyond the interface over the index on this side

// lab_sampler: integrands over the unit square, by `variant`
SHARED_CONST uint kIntegrandBump = 0u;  // 36 x (1 - x) y (1 - y)
SHARED_CONST uint kIntegrandSlope = 1u; // 1 / (1 + x + y)
SHARED_CONST uint kIntegrandRidge = 2u; // 1 / (1 + 25 (x - y)^2)
SHARED_CONST uint kIntegrandDisk = 3u;  // 1 where x^2 + y^2 < 1, else 0: not smooth
SHARED_CONST uint kIntegrandCount = 4u;

LAVALIGHT_SHARED_END

#endif
