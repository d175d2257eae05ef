// What a scene may have or not. Kernels leave out the code for what theirs has not: lib/features.glsl.
#ifndef LAVALIGHT_SHARED_FEATURES_H
#define LAVALIGHT_SHARED_FEATURES_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// On the host a set of 64 bits, of which kernels get two words; in a kernel the number of one bit.
#ifdef __cplusplus
using SceneFeatures = uint64_t;
#define SHARED_FEATURE(number) (SceneFeatures{1} << (number))
#else
#define SceneFeatures uint
#define SHARED_FEATURE(number) number
#endif

SHARED_CONST SceneFeatures kFeatureSpecular = SHARED_FEATURE(0u);    // a surface that is not pure Lambert
SHARED_CONST SceneFeatures kFeatureGlass = SHARED_FEATURE(1u);       // a transmissive one
SHARED_CONST SceneFeatures kFeatureRoughLobes = SHARED_FEATURE(2u);  // such a lobe with alpha of kSmoothAlpha or more
SHARED_CONST SceneFeatures kFeatureSmoothLobes = SHARED_FEATURE(3u); // such a lobe with a smaller alpha
SHARED_CONST SceneFeatures kFeatureShadingNormals = SHARED_FEATURE(4u);
SHARED_CONST SceneFeatures kFeatureTriangleLights = SHARED_FEATURE(5u);
SHARED_CONST SceneFeatures kFeaturePunctualLights = SHARED_FEATURE(6u);
SHARED_CONST SceneFeatures kFeatureEnvironment = SHARED_FEATURE(7u);
SHARED_CONST SceneFeatures kFeatureLightTree = SHARED_FEATURE(8u);
SHARED_CONST SceneFeatures kFeatureTextures = SHARED_FEATURE(9u);
SHARED_CONST SceneFeatures kFeatureVertexColors = SHARED_FEATURE(10u);
SHARED_CONST SceneFeatures kFeatureTangents = SHARED_FEATURE(11u); // tangents of normal maps and anisotropy
SHARED_CONST SceneFeatures kFeatureAlpha = SHARED_FEATURE(12u);
SHARED_CONST SceneFeatures kFeatureUnlit = SHARED_FEATURE(13u);
SHARED_CONST SceneFeatures kFeatureEnvironmentMap = SHARED_FEATURE(14u);
SHARED_CONST SceneFeatures kFeatureAttenuation = SHARED_FEATURE(15u); // behind open surfaces
SHARED_CONST SceneFeatures kFeatureDispersion = SHARED_FEATURE(16u);
SHARED_CONST SceneFeatures kFeatureClearcoat = SHARED_FEATURE(17u);
SHARED_CONST SceneFeatures kFeatureSheen = SHARED_FEATURE(18u);
SHARED_CONST SceneFeatures kFeatureAnisotropy = SHARED_FEATURE(19u);
SHARED_CONST SceneFeatures kFeatureIridescence = SHARED_FEATURE(20u);
SHARED_CONST SceneFeatures kFeatureDiffuseTransmission = SHARED_FEATURE(21u);
SHARED_CONST SceneFeatures kFeatureLights = SHARED_FEATURE(22u);           // there are any
SHARED_CONST SceneFeatures kFeatureEnvironmentLight = SHARED_FEATURE(23u); // the environment is among them
SHARED_CONST SceneFeatures kFeatureLightRange = SHARED_FEATURE(24u);       // of punctual lights
SHARED_CONST SceneFeatures kFeatureTangentPlanes = SHARED_FEATURE(30u); // several, for textures of different coordinates
SHARED_CONST SceneFeatures kFeatureCoatedLights = SHARED_FEATURE(31u);  // emission below a clearcoat
// Bits of the second word.
SHARED_CONST SceneFeatures kFeatureLens = SHARED_FEATURE(32u); // the camera's, as the next two
SHARED_CONST SceneFeatures kFeaturePanorama = SHARED_FEATURE(33u);
SHARED_CONST SceneFeatures kFeatureOrthographic = SHARED_FEATURE(34u);
SHARED_CONST SceneFeatures kFeatureSolids = SHARED_FEATURE(35u);        // paths keep a list of the solids that they are in
SHARED_CONST SceneFeatures kFeatureManyTriangles = SHARED_FEATURE(36u); // so that it pays to trace alike rays together
SHARED_CONST SceneFeatures kFeatureStartsVary = SHARED_FEATURE(37u);    // camera rays start in different solids
SHARED_CONST SceneFeatures kFeatureEmission = SHARED_FEATURE(38u);      // a surface that emits
SHARED_CONST SceneFeatures kFeatureShadowCatcher = SHARED_FEATURE(44u); // camera rays that meet nothing may meet the ground
SHARED_CONST SceneFeatures kFeatureSun = SHARED_FEATURE(41u);    // a disc in the environment map
SHARED_CONST SceneFeatures kFeatureLayers = SHARED_FEATURE(40u); // a render records PathLayers
SHARED_CONST SceneFeatures kFeatureCrop = SHARED_FEATURE(42u);   // a part of the image is rendered
SHARED_CONST SceneFeatures kFeatureFilter = SHARED_FEATURE(43u); // of pixels, other than the box of one pixel
SHARED_CONST SceneFeatures kFeatureBackground = SHARED_FEATURE(39u); // camera rays see it in place of the environment

LAVALIGHT_SHARED_END

#endif
