// What the scene at hand has, as a specialisation constant: code for what it has not is left out when a driver compiles the
// kernels. lavapipe executes both sides of every `if`, so that a plain scene would pay for all materials and lights.
#ifndef LAVALIGHT_FEATURES_GLSL
#define LAVALIGHT_FEATURES_GLSL

#include "shared/frame.h"
#include "shared/scene.h"

layout(constant_id = CONSTANT_FEATURES) const uint kFeatures = kAllFeatures;

// sceneHas() is a macro, and so a constant by itself, where a function's result would pass through a variable: what it guards
// goes early.
#define sceneHas(feature) ((kFeatures & (feature)) != 0u)

#endif
