// What is the same for every path of a render: camera, image, settings.
#ifndef LAVALIGHT_SHARED_FRAME_H
#define LAVALIGHT_SHARED_FRAME_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

struct FrameParameters {
    vec3 cameraPosition;
    uint projection; // kProjection...
    vec3 cameraRight; // half the width of the image plane at distance 1 (perspective) or of the view (orthographic)
    uint imageWidth;
    vec3 cameraUp; // half the height, as above
    uint imageHeight;
    vec3 cameraForward; // unit length
    uint seed;
    vec3 environment; // constant radiance, or what the map's texels are multiplied by
    uint lightColumns; // columns of the alias table of lights; 0: there are no lights
    vec3 sceneCenter; // centre of the sphere around everything, where light from infinity starts
    float sceneRadius;
    uint environmentLight; // index among the lights, or kNoLight
    uint maxBounces;
    uint rouletteStart; // first vertex (the camera's first hit is vertex 1) where a path may die
    float rouletteProbability; // probability of survival, for the constant kind
    float clampIndirect; // largest channel of what a path may bring from beyond its first vertex; infinite: no clamp
    uint bandPixels;     // pixels of the film at hand
    uint waveSize;       // slots
    uint firstLightColumn; // among the lights; those before it are in the light tree
    uint environmentWidth; // texels of the map; 0: there is none
    uint environmentHeight;
    float environmentRotation; // turns (lib/math/equirectangular.glsl says which way u grows)
    float lensRadius;          // metres; 0: pinhole
    float focusDistance;       // metres along cameraForward to the plane that is sharp
    float clipNear;  // metres along cameraForward; what is nearer is not seen by camera rays
    float clipDepth; // metres from there to where they end; infinite: nowhere
    uint startOuter;     // the InteriorList at startReference, as the next two
    vec3 startReference; // where camera rays start, or near there
    uint startInner;
    uint startNotes;
    uint startsVary;    // kFeatureStartsVary is wanted
    uint hasBackground; // kFeatureBackground is wanted
    uint hasLayers;     // kFeatureLayers is wanted
    vec3 background; // radiance
    float sunShare;  // probability that a sample of the environment is one of the sun
    vec3 sunDirection;
    float sunSize; // 1 - the cosine of its angular radius
    vec3 sunRadiance;
    uint cropStart;  // first pixel of the image that is rendered
    uint cropWidth;  // pixels of a row that are rendered, all imageWidth unless kFeatureCrop is wanted
    uint hasFilter; // kFeatureFilter is wanted
    float filterPositive; // share of the pixel filter along an axis that has no negative sign
    float filterScale;    // weight of a sample, without its sign
    // Where the pixel filter puts samples (lib/sampling/pixel_filter.glsl): offsets from the middle, in pixels.
    vec4 filterNodes[33];
    // The camera of the next frame, as above, for kMotionPlane.
    vec3 nextPosition;
    uint catchesShadows; // kFeatureShadowCatcher is wanted
    vec3 nextRight;
    float groundHeight; // y of the plane that catches shadows
    vec3 nextUp;
    float axisX; // where the axis of the view meets the image, in halves of its sides from the top left: 1 is the middle
    vec3 nextForward;
    float axisY;
};

// Intervals of filterNodes, whose last node ends the last of them.
SHARED_CONST uint kFilterIntervals = 128u;

// Specialisation constants: the estimator settings that pick code (lib/estimator.glsl).
#define CONSTANT_SAMPLER 0
#define CONSTANT_HEMISPHERE 1
#define CONSTANT_NEE 2
#define CONSTANT_MIS 3
#define CONSTANT_ROULETTE 4
#define CONSTANT_MIS_SURVIVAL 5
#define CONSTANT_FRESNEL 6
#define CONSTANT_FEATURES 7 // features of the scene, not of the estimator (lib/features.glsl)
#define CONSTANT_MORE_FEATURES 11 // the second word of features
#define CONSTANT_COUNT_VISITS 8 // visits of traversal (scene/intersect.glsl)
#define CONSTANT_MULTIPLE_SCATTERING 9
#define CONSTANT_TEXTURE_FILTER 10
#define CONSTANT_FILM_PLANES 12 // planes of the film (scene/film.glsl)
#define CONSTANT_SMOOTH_TERMINATOR 13
#define CONSTANT_RECORD_PLANES 14 // planes of the hosted schedule's records (shared/records.h)

SHARED_CONST uint kProjectionPerspective = 0u;
SHARED_CONST uint kProjectionOrthographic = 1u;
SHARED_CONST uint kProjectionPanorama = 2u; // all directions, as in lib/math/equirectangular.glsl

// Values of those constants; the C++ enumerations use the same numbers.
SHARED_CONST uint kSamplerSobol = 0u;
SHARED_CONST uint kSamplerIndependent = 1u;
SHARED_CONST uint kHemisphereCosine = 0u;
SHARED_CONST uint kHemisphereUniform = 1u;
SHARED_CONST uint kMisPower = 0u;
SHARED_CONST uint kMisBalance = 1u;
SHARED_CONST uint kMisOff = 2u;
SHARED_CONST uint kRouletteThroughput = 0u;
SHARED_CONST uint kRouletteOff = 1u;
SHARED_CONST uint kRouletteConstant = 2u;
SHARED_CONST uint kRouletteMeanAlbedo = 3u;
SHARED_CONST uint kRouletteMaxAlbedo = 4u;
SHARED_CONST uint kRouletteSqrtThroughput = 5u;
SHARED_CONST uint kRouletteCbrtThroughput = 6u;
SHARED_CONST uint kFresnelExact = 0u;
SHARED_CONST uint kFresnelSchlick = 1u;
SHARED_CONST uint kTextureFilterBilinear = 0u;
SHARED_CONST uint kTextureFilterStochastic = 1u;

LAVALIGHT_SHARED_END

#endif
