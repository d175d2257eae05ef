// What the scene at hand has, as specialisation constants: code for what it has not is left out when a driver compiles the
// kernels. lavapipe executes both sides of every `if`, so that a plain scene would pay for all materials and lights.
#ifndef LAVALIGHT_FEATURES_GLSL
#define LAVALIGHT_FEATURES_GLSL

#include "shared/features.h"
#include "shared/frame.h"

layout(constant_id = CONSTANT_FEATURES) const uint kFeatures = 0xffffffffu;
layout(constant_id = CONSTANT_MORE_FEATURES) const uint kMoreFeatures = 0xffffffffu; // from the 32nd on

// sceneHas() is a macro, and so a constant by itself, where a function's result would pass through a variable: what it guards
// goes early. The compiler picks the word.
#define sceneHas(feature) ((((feature) < 32u ? kFeatures : kMoreFeatures) & (1u << ((feature) & 31u))) != 0u)

#endif
