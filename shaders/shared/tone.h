// What the tonemap kernel is told: the curve from radiance to the display, and which plane of the film it shows.
#ifndef LAVALIGHT_SHARED_TONE_H
#define LAVALIGHT_SHARED_TONE_H

#include "shared/film.h"
#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// Push constants.
struct ToneRange {
    uint bandPixels; // pixels of the film at hand
    uint firstPixel; // first pixel of this dispatch, in the band
    float scale;     // factor of radiance: 2^exposure
    uint countWord;  // index of the word plane that counts samples
    uint firstWord;  // index of the first word plane of the plane that is shown
    FilmPlane plane;
};

// A specialisation constant: the curve picks code.
#define CONSTANT_TONE_CURVE 0

// Values of the tone curve; ToneCurve in C++ uses the same numbers.
SHARED_CONST uint kToneLinear = 0u;
SHARED_CONST uint kToneNeutral = 1u;
SHARED_CONST uint kToneAgx = 2u;
SHARED_CONST uint kToneAces = 3u;

LAVALIGHT_SHARED_END

#endif
