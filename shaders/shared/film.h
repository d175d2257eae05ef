// Layout of the exact film: planes of fixed-point sums per pixel, stored word by word over a band.
#ifndef LAVALIGHT_SHARED_FILM_H
#define LAVALIGHT_SHARED_FILM_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// Sum of values without sign: 96 bits, the lowest worth 2^-48. A sample of 1e-6 keeps 28 significant bits; 2^28 samples
// of 1e6 fit. What leaves the range stays at the largest sum.
SHARED_CONST uint kSumWords = 3u;
SHARED_CONST int kSumLowestExponent = -48;
// Sum of signed values: two's complement of 128 bits in the same unit. Samples are limited to +-kMostSigned = 2^47, so
// that 2^32 of them, which is all that a pixel counts, never leave the range: a sum that saturated on its way would
// depend on the order of its samples, as the next one may lead back.
SHARED_CONST uint kSignedSumWords = 4u;
SHARED_CONST float kMostSigned = 140737488355328.0f;
// Sum of squares: 128 bits, the lowest worth 2^-64. (1e-6)^2 keeps 24 bits; 2^24 samples of (1e6)^2 fit.
SHARED_CONST uint kSquareWords = 4u;
SHARED_CONST int kSquareLowestExponent = -64;

// Which values a plane has. A sum with a sign takes a word more.
SHARED_CONST uint kWithoutSign = 0u; // negative ones are counted, and taken for 0
SHARED_CONST uint kWithSign = 1u;
SHARED_CONST uint kWeighted = 2u; // those of samples have the weight of the pixel filter, which may be negative

// A plane holds one kind of value that samples have. Its words hold one component after another, each the sum's words,
// then the square's, lowest first.
struct FilmPlane {
    uint components; // 1 to 3
    uint isSigned;   // 0: negative values are counted, and taken for 0
    uint hasSquares; // 0: there is no variance
    uint isPerHit;   // 1: means are over the camera paths that met something, which kHitsPlane counts
};

SHARED_FUNCTION uint sumWordsOf(FilmPlane plane) {
    return plane.isSigned != 0u ? kSignedSumWords : kSumWords;
}

SHARED_FUNCTION uint componentWordsOf(FilmPlane plane) {
    return sumWordsOf(plane) + (plane.hasSquares != 0u ? kSquareWords : 0u);
}

SHARED_FUNCTION uint wordsOf(FilmPlane plane) {
    return plane.components * componentWordsOf(plane);
}

// Numbers of the rows below.
SHARED_CONST uint kColorPlane = 0u;
SHARED_CONST uint kCoveragePlane = 1u; // 1 where the camera ray met something, 0 elsewhere: with a transparent background
SHARED_CONST uint kHitsPlane = 2u;     // the same, for planes that are means over hits
SHARED_CONST uint kAlbedoPlane = 3u;   // directional albedo, as the next four of the first surface
SHARED_CONST uint kNormalPlane = 4u;   // in the world, towards the camera
SHARED_CONST uint kDepthPlane = 5u;    // metres along the camera's view; of a panorama, along the ray
SHARED_CONST uint kPositionPlane = 6u; // metres from the scene's origin
SHARED_CONST uint kUvPlane = 7u;       // TEXCOORD_0, as the file has it
SHARED_CONST uint kEmissionPlane = 8u; // radiance that is seen directly: of the first surface, or of the background
SHARED_CONST uint kDirectPlane = 9u;   // of the colour, light that was scattered once at most
SHARED_CONST uint kIndirectPlane = 10u; // of the colour, the rest: its sums are the differences
SHARED_CONST uint kMotionPlane = 11u;  // pixels to where the surface is in the next frame, right and down
SHARED_CONST uint kGuideAlbedoPlane = 12u; // for denoisers: of the first surface that is no smooth mirror or glass
SHARED_CONST uint kGuideNormalPlane = 13u;
// Shadows on the ground (scene/shadow_catcher.glsl): the share of paths that it catches; luminance of the direct light there;
// and the part of that which nothing is in the way of. shared/shadow.h makes alpha of them.
SHARED_CONST uint kShadowPlane = 14u;
SHARED_CONST uint kBehindPlane = 15u; // background that those paths see, which the shadow darkens

// All planes that there are, a row each in the order of their numbers: number, name of the layer, channels in EXR files,
// components, sign, hasSquares, isPerHit. A film has the colour and those that were asked for, in this order;
// shaders/scene/film_sink.glsl says what fills them.
#define FILM_PLANES(PLANE) \
    PLANE(kColorPlane, "color", "R,G,B", 3u, kWeighted, 1u, 0u) \
    PLANE(kCoveragePlane, "coverage", "A", 1u, kWeighted, 0u, 0u) \
    PLANE(kHitsPlane, "hits", "hits.N", 1u, kWithoutSign, 0u, 0u) \
    PLANE(kAlbedoPlane, "albedo", "albedo.R,albedo.G,albedo.B", 3u, kWithoutSign, 0u, 0u) \
    PLANE(kNormalPlane, "normal", "normal.X,normal.Y,normal.Z", 3u, kWithSign, 0u, 1u) \
    PLANE(kDepthPlane, "depth", "depth.Z", 1u, kWithSign, 0u, 1u) \
    PLANE(kPositionPlane, "position", "position.X,position.Y,position.Z", 3u, kWithSign, 0u, 1u) \
    PLANE(kUvPlane, "uv", "uv.U,uv.V", 2u, kWithSign, 0u, 1u) \
    PLANE(kEmissionPlane, "emission", "emission.R,emission.G,emission.B", 3u, kWeighted, 0u, 0u) \
    PLANE(kDirectPlane, "direct", "direct.R,direct.G,direct.B", 3u, kWeighted, 1u, 0u) \
    PLANE(kIndirectPlane, "indirect", "indirect.R,indirect.G,indirect.B", 3u, kWeighted, 1u, 0u) \
    PLANE(kMotionPlane, "motion", "motion.X,motion.Y", 2u, kWithSign, 0u, 1u) \
    PLANE(kGuideAlbedoPlane, "guide-albedo", "guide-albedo.R,guide-albedo.G,guide-albedo.B", 3u, kWithoutSign, 0u, 0u) \
    PLANE(kGuideNormalPlane, "guide-normal", "guide-normal.X,guide-normal.Y,guide-normal.Z", 3u, kWithSign, 0u, 0u) \
    PLANE(kShadowPlane, "shadow", "shadow.N,shadow.lit,shadow.visible", 3u, kWeighted, 0u, 0u) \
    PLANE(kBehindPlane, "behind", "behind.R,behind.G,behind.B", 3u, kWeighted, 0u, 0u)

// A film's planes are asked for by a word: bit i for row i, and this bit where weighted planes have a sign.
SHARED_CONST uint kNegativeWeights = 0x80000000u;

// Layers that are no means and so no planes: the host counts which surfaces the samples of a pixel met.
SHARED_CONST uint kObjectIds = 0x40000000u;
SHARED_CONST uint kMaterialIds = 0x20000000u;
SHARED_CONST uint kCryptomatte = 0x10000000u; // both, as files that compositing programs read

// Where the sink puts the surface of each sample for the host: that of a sample that is in no plane.
SHARED_CONST uint kDroppedSample = 0xfffffffeu;

#define FILM_PLANE_COUNT(number, name, channels, components, sign, hasSquares, isPerHit) + 1u
SHARED_CONST uint kFilmPlaneCount = 0u FILM_PLANES(FILM_PLANE_COUNT);

// The fields of a row, and of a plane as a film has it: expressions, which are constants where `plane` is one. Compilers do not
// see through a table.
SHARED_FUNCTION uint signOf(uint plane) {
#define FILM_PLANE_SIGN(number, name, channels, components, sign, hasSquares, isPerHit) + (number == plane ? sign : 0u)
    return 0u FILM_PLANES(FILM_PLANE_SIGN);
}

SHARED_FUNCTION FilmPlane shapeOf(uint plane, uint asked) {
#define FILM_PLANE_COMPONENTS(number, name, channels, components, sign, hasSquares, isPerHit) \
    + (number == plane ? components : 0u)
#define FILM_PLANE_SQUARES(number, name, channels, components, sign, hasSquares, isPerHit) \
    + (number == plane ? hasSquares : 0u)
#define FILM_PLANE_PER_HIT(number, name, channels, components, sign, hasSquares, isPerHit) \
    + (number == plane ? isPerHit : 0u)
    FilmPlane shape;
    shape.components = 0u FILM_PLANES(FILM_PLANE_COMPONENTS);
    shape.isSigned = signOf(plane) == kWeighted ? asked >> 31u : signOf(plane);
    // Planes without squares make both branches 0. NOLINTBEGIN(bugprone-branch-clone)
    shape.hasSquares = 0u FILM_PLANES(FILM_PLANE_SQUARES);
    shape.isPerHit = 0u FILM_PLANES(FILM_PLANE_PER_HIT);
    // NOLINTEND(bugprone-branch-clone)
    return shape;
}

// Word planes of a band's film, each as long as the band has pixels: its planes, and last the number of samples.
//
//   R.sum[3] R.square[4]  G.sum[3] G.square[4]  B.sum[3] B.square[4]  ...  count
//
// The sum is written out, row by row, since compilers see through no loop here.
SHARED_FUNCTION uint firstWordOf(uint plane, uint asked) {
#define FILM_PLANE_WORDS(number, name, channels, components, sign, hasSquares, isPerHit) \
    + (number < plane ? (asked >> number & 1u) * components * \
                            (kSumWords + (sign == kWeighted ? asked >> 31u : sign) + hasSquares * kSquareWords) : 0u)
    return 0u FILM_PLANES(FILM_PLANE_WORDS);
}

SHARED_FUNCTION uint countWordOf(uint asked) {
    return firstWordOf(kFilmPlaneCount, asked);
}

// 64-bit counts of what happened, as pairs of words (low, high).
SHARED_CONST uint kTallyDropped = 0u;       // samples with NaN or infinity: counted, never added
SHARED_CONST uint kTallySaturated = 1u;     // sums that left the film's range
SHARED_CONST uint kTallyCutPaths = 2u;      // paths that --max-bounces ended while they carried light
SHARED_CONST uint kTallyCutThroughput = 3u; // sum of their mean throughput, in units of 2^-16
SHARED_CONST uint kTallyCrowded = 4u;       // paths that were within more solids at once than their lists hold
SHARED_CONST uint kTallyCrowdedSolid = 5u;  // no count: number of a solid that such a path was in
SHARED_CONST uint kTallyNegative = 6u;      // samples below 0 in a plane without sign, which counted as 0 there
SHARED_CONST uint kTallyLimited = 7u;       // values that were limited to +-kMostSigned
SHARED_CONST uint kTallyCount = 8u;

LAVALIGHT_SHARED_END

#endif
