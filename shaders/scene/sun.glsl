// The sun: a disc of one radiance in the environment, with a share of its samples.
#include "lib/features.glsl"
#include "lib/math/constants.glsl"
#include "lib/math/onb.glsl"
#include "shared/frame.h"

// Solid angle of the disc, sr. sunSize: 1 - the cosine of its angular radius.
float sunSolidAngle(FrameParameters parameters) {
    return 2.0 * kPi * parameters.sunSize;
}

// By the chord: a cosine near 1 has no digits left.
bool isInSun(FrameParameters parameters, vec3 wi) {
    const vec3 chord = wi - parameters.sunDirection;
    return dot(chord, chord) <= 2.0 * parameters.sunSize;
}

// The ground hides what is below the horizon.
vec3 sunRadiance(FrameParameters parameters, vec3 wi) {
    return sceneHas(kFeatureSun) && wi.y >= 0.0 && isInSun(parameters, wi) ? parameters.sunRadiance : vec3(0.0);
}

// Uniform over the disc.
vec3 squareToSun(FrameParameters parameters, vec2 u) {
    const float drop = u.x * parameters.sunSize; // 1 - the cosine
    const float across = sqrt(drop * (2.0 - drop));
    const float phi = 2.0 * kPi * u.y;
    return toWorld(makeBasis(parameters.sunDirection), vec3(across * cos(phi), across * sin(phi), 1.0 - drop));
}

// The density of a sample of environment and sun, where that of the environment alone is `pdf`.
float withSunPdf(FrameParameters parameters, vec3 wi, float pdf) {
    if (!sceneHas(kFeatureSun))
        return pdf;
    const float inSun = isInSun(parameters, wi) ? 1.0 / sunSolidAngle(parameters) : 0.0;
    return mix(pdf, inSun, parameters.sunShare);
}
