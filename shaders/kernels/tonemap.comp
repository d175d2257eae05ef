#version 460
// A plane of the film as a display shows it, one invocation a pixel: means, exposed, mapped, encoded, in 8 bits a channel. Alpha
// is straight: a colour is divided by its coverage before the curve.
#include "lib/film/fixed_point.glsl"
#include "lib/film/tone_map.glsl"
#include "shared/bindings.h"
#include "shared/film.h"

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

float coverageSum(uint pixel) {
    const uint first = range.coverageWord;
    if (range.isImage != 0u)
        return uintBitsToFloat(wordOf(first, pixel));
    return fromFixed(uvec3(wordOf(first, pixel), wordOf(first + 1u, pixel), wordOf(first + 2u, pixel)), kSumLowestExponent);
}

// A single component is grey; a second stands beside no third.
vec3 sums(uint pixel) {
    const float x = sumOf(0u, pixel);
    if (range.plane.components == 1u)
        return vec3(x);
    return vec3(x, sumOf(1u, pixel), range.plane.components > 2u ? sumOf(2u, pixel) : 0.0);
}

void main() {
    const uint pixel = range.firstPixel + gl_GlobalInvocationID.x;
    if (pixel >= range.bandPixels)
        return;
    const uint count = range.isImage != 0u ? 1u : wordOf(range.countWord, pixel);
    const float samples = float(max(count, 1u));
    float alpha = range.coverageWord > 0u ? min(coverageSum(pixel) / samples, 1.0) : 1.0;
    const vec3 mean = max(sums(pixel) / samples, 0.0); // black without samples
    const vec3 straight = alpha > 0.0 ? mean / alpha : vec3(0.0);
    vec3 shown = toneMap(kToneCurve, range.scale * straight);
    if (range.hasBackdrop != 0u) {
        shown = mix(range.backdrop, shown, alpha);
        alpha = 1.0;
    }
    const uvec4 code = uvec4(255.0 * vec4(encodeSrgb(shown), alpha) + 0.5);
    display[pixel] = code.r | code.g << 8u | code.b << 16u | code.a << 24u;
}
