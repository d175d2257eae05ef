// What the tonemap kernel is told: the curve from radiance to the display, and which plane of the film it shows.
#ifndef LAVALIGHT_SHARED_TONE_H
#define LAVALIGHT_SHARED_TONE_H

#include "shared/film.h"
#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// Push constants.
struct ToneRange {
    vec3 backdrop;    // linear display values behind what is not covered, with hasBackdrop
    uint hasBackdrop; // 0: pixels keep their alpha
    uint bandPixels; // pixels of the film at hand
    uint firstPixel; // first pixel of this dispatch, in the band
    float scale;     // factor of radiance: 2^exposure
    uint countWord;  // index of the word plane that counts samples
    uint firstWord;  // index of the first word plane of the plane that is shown
    uint coverageWord; // the same of the plane of coverage, by which the colour is associated; 0: all is covered
    FilmPlane plane;
    uint isImage; // 1: each component is one word that holds a float, and no samples are counted
    uint shadowWord; // as coverageWord, of kShadowPlane; of an image, the word of that part of its coverage; 0: no shadows
    uint behindWord; // the same of kBehindPlane, where the shadow has not been taken from what is shown
    uint unused0;
    uint unused1;
    uint unused2;
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
