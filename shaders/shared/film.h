// Layout of the exact film: fixed-point sums per pixel, stored word by word over a band.
#ifndef LAVALIGHT_SHARED_FILM_H
#define LAVALIGHT_SHARED_FILM_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// Sum of L: 96 bits, the lowest worth 2^-48. A sample of 1e-6 keeps 28 significant bits; 2^28 samples of 1e6 fit.
SHARED_CONST uint kSumWords = 3u;
SHARED_CONST int kSumLowestExponent = -48;
// Sum of L^2: 128 bits, the lowest worth 2^-64. (1e-6)^2 keeps 24 bits; 2^24 samples of (1e6)^2 fit.
SHARED_CONST uint kSquareWords = 4u;
SHARED_CONST int kSquareLowestExponent = -64;

// Word planes of a band's film, each as long as the band has pixels: per channel the sum's words, then the square's,
// lowest first; last the sample count.
//
//   R.sum[3] R.square[4]  G.sum[3] G.square[4]  B.sum[3] B.square[4]  count
SHARED_CONST uint kChannelWords = kSumWords + kSquareWords;
SHARED_CONST uint kCountPlane = 3u * kChannelWords;
SHARED_CONST uint kFilmWords = kCountPlane + 1u;

// 64-bit counts of what happened, as pairs of words (low, high).
SHARED_CONST uint kTallyDropped = 0u;       // samples with NaN or infinity: counted, never added
SHARED_CONST uint kTallySaturated = 1u;     // sums that left the film's range
SHARED_CONST uint kTallyCutPaths = 2u;      // paths that --max-bounces ended while they carried light
SHARED_CONST uint kTallyCutThroughput = 3u; // sum of their mean throughput, in units of 2^-16
SHARED_CONST uint kTallyOverlaps = 4u;      // paths that were within two solids at once
SHARED_CONST uint kTallyOverlapPair = 5u;   // no count: numbers of the meshes of two such solids, 16 bits each
SHARED_CONST uint kTallyCount = 6u;

LAVALIGHT_SHARED_END

#endif
