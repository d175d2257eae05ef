#version 460
// A plane of the film as a display shows it, one invocation a pixel: means, exposed, mapped, encoded, in 8 bits a channel.
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
    const uint first = range.firstWord + component * componentWordsOf(range.plane);
    const uvec3 low = uvec3(wordOf(first, pixel), wordOf(first + 1u, pixel), wordOf(first + 2u, pixel));
    return range.plane.isSigned != 0u ? fromSigned(uvec4(low, wordOf(first + 3u, pixel)), kSumLowestExponent)
                                      : fromFixed(low, kSumLowestExponent);
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
    const uint count = wordOf(range.countWord, pixel);
    const vec3 mean = max(sums(pixel) / float(max(count, 1u)), 0.0); // black without samples
    const vec3 signal = encodeSrgb(toneMap(kToneCurve, range.scale * mean));
    const uvec3 code = uvec3(255.0 * signal + 0.5);
    display[pixel] = code.r | code.g << 8u | code.b << 16u | 0xff000000u;
}
