#version 460
// A plane of the film as a display shows it, one invocation a pixel: means, exposed, mapped, encoded, in 8 bits a channel. Alpha
// is straight: a colour is divided by its coverage before the curve. A shadow on the ground is black after it.
#include "lib/film/fixed_point.glsl"
#include "lib/film/tone_map.glsl"
#include "shared/bindings.h"
#include "shared/film.h"
#include "shared/shadow.h"

layout(local_size_x = 64) in;
layout(constant_id = CONSTANT_TONE_CURVE) const uint kToneCurve = kToneLinear;
layout(set = 0, binding = BINDING_FILM, std430) readonly buffer Film { uint film[]; };
layout(set = 0, binding = BINDING_DISPLAY, std430) writeonly buffer Display { uint display[]; };
layout(push_constant) uniform Range { ToneRange range; };

uint wordOf(uint word, uint pixel) {
    return film[word * range.bandPixels + pixel];
}

float sumOf(uint component, uint pixel) {
    if (range.isImage != 0u)
        return uintBitsToFloat(wordOf(range.firstWord + component, pixel));
    const uint first = range.firstWord + component * componentWordsOf(range.plane);
    const uvec3 low = uvec3(wordOf(first, pixel), wordOf(first + 1u, pixel), wordOf(first + 2u, pixel));
    return range.plane.isSigned != 0u ? fromSigned(uvec4(low, wordOf(first + 3u, pixel)), kSumLowestExponent)
                                      : fromFixed(low, kSumLowestExponent);
}

// The sum of a component without squares that has a sign where the shown plane has one: both are weighted.
float plainSum(uint first, uint pixel) {
    if (range.isImage != 0u)
        return uintBitsToFloat(wordOf(first, pixel));
    const uvec3 low = uvec3(wordOf(first, pixel), wordOf(first + 1u, pixel), wordOf(first + 2u, pixel));
    return range.plane.isSigned != 0u ? fromSigned(uvec4(low, wordOf(first + 3u, pixel)), kSumLowestExponent)
                                      : fromFixed(low, kSumLowestExponent);
}

vec3 plainSums(uint first, uint pixel) {
    const uint words = sumWordsOf(range.plane);
    return vec3(plainSum(first, pixel), plainSum(first + words, pixel), plainSum(first + 2u * words, pixel));
}

// A single component is grey; a second stands beside no third.
vec3 sums(uint pixel) {
    const float x = sumOf(0u, pixel);
    if (range.plane.components == 1u)
        return vec3(x);
    return vec3(x, sumOf(1u, pixel), range.plane.components > 2u ? sumOf(2u, pixel) : 0.0);
}

struct Shadow {
    float alpha; // what it adds to alpha
    float share; // of the background behind it, which it takes away
};

Shadow shadowAt(uint pixel, float samples) {
    if (range.shadowWord == 0u)
        return Shadow(0.0, 0.0);
    if (range.isImage != 0u)
        return Shadow(plainSum(range.shadowWord, pixel), 0.0);
    const vec3 shadow = plainSums(range.shadowWord, pixel) / samples;
    const float share = shadowOf(shadow.y, shadow.z);
    return Shadow(max(shadow.x * share, 0.0), share);
}

void main() {
    const uint pixel = range.firstPixel + gl_GlobalInvocationID.x;
    if (pixel >= range.bandPixels)
        return;
    const uint count = range.isImage != 0u ? 1u : wordOf(range.countWord, pixel);
    const float samples = float(max(count, 1u));
    const Shadow shadow = shadowAt(pixel, samples);
    vec3 sum = sums(pixel);
    if (range.behindWord > 0u)
        sum -= shadow.share * plainSums(range.behindWord, pixel);
    float alpha = range.coverageWord > 0u ? clamp(plainSum(range.coverageWord, pixel) / samples, 0.0, 1.0) : 1.0;
    float covered = alpha;
    if (range.shadowWord > 0u && range.coverageWord > 0u) {
        covered = range.isImage != 0u ? max(alpha - shadow.alpha, 0.0) : alpha;
        alpha = min(covered + shadow.alpha, 1.0);
    }
    const vec3 mean = max(sum / samples, 0.0); // black without samples
    const vec3 straight = covered > 0.0 ? mean / covered : vec3(0.0);
    vec3 shown = toneMap(kToneCurve, range.scale * straight);
    if (covered < alpha)
        shown *= covered / alpha;
    if (range.hasBackdrop != 0u) {
        shown = mix(range.backdrop, shown, alpha);
        alpha = 1.0;
    }
    const uvec4 code = uvec4(255.0 * vec4(encodeSrgb(shown), alpha) + 0.5);
    display[pixel] = code.r | code.g << 8u | code.b << 16u | code.a << 24u;
}
