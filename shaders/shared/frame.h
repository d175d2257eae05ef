// What is the same for every path of a render: camera, image, settings.
#ifndef LAVALIGHT_SHARED_FRAME_H
#define LAVALIGHT_SHARED_FRAME_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

struct FrameParameters {
    vec3 cameraPosition;
    uint isOrthographic;
    vec3 cameraRight; // half the width of the image plane at distance 1 (perspective) or of the view (orthographic)
    uint imageWidth;
    vec3 cameraUp; // half the height, as above
    uint imageHeight;
    vec3 cameraForward; // unit length
    uint seed;
    vec3 environment; // constant radiance
    uint emitterCount;
    uint maxBounces;
    uint rouletteStart; // first vertex (the camera's first hit is vertex 1) where a path may die
    uint bandPixels;    // pixels of the film at hand
    uint waveSize;      // slots
};

// Specialisation constants: the estimator settings that pick code.
#define CONSTANT_NEE 0
#define CONSTANT_MIS 1
#define CONSTANT_ROULETTE 2

// Values of those constants; the C++ enumerations use the same numbers.
SHARED_CONST uint kMisPower = 0u;
SHARED_CONST uint kMisBalance = 1u;
SHARED_CONST uint kMisOff = 2u;
SHARED_CONST uint kRouletteThroughput = 0u;
SHARED_CONST uint kRouletteOff = 1u;

LAVALIGHT_SHARED_END

#endif
