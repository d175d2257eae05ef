#version 460
// The film as a display shows it, one invocation a pixel: mean radiance, exposed, mapped, encoded, in 8 bits a channel.
#include "lib/film/fixed_point.glsl"
#include "lib/film/tone_map.glsl"
#include "shared/bindings.h"
#include "shared/film.h"

layout(local_size_x = 64) in;
layout(constant_id = CONSTANT_TONE_CURVE) const uint kToneCurve = kToneLinear;
layout(set = 0, binding = BINDING_FILM, std430) readonly buffer Film { uint film[]; };
layout(set = 0, binding = BINDING_DISPLAY, std430) writeonly buffer Display { uint display[]; };
layout(push_constant) uniform Range { ToneRange range; };

float sumOf(uint channel, uint pixel) {
    const uint low = channel * kChannelWords * range.bandPixels + pixel;
    const uvec3 words = uvec3(film[low], film[low + range.bandPixels], film[low + 2u * range.bandPixels]);
    return fromFixed(words, kSumLowestExponent);
}

void main() {
    const uint pixel = range.firstPixel + gl_GlobalInvocationID.x;
    if (pixel >= range.bandPixels)
        return;
    const vec3 sum = vec3(sumOf(0u, pixel), sumOf(1u, pixel), sumOf(2u, pixel));
    const uint count = film[kCountPlane * range.bandPixels + pixel];
    const vec3 radiance = sum / float(max(count, 1u)); // black without samples
    const vec3 signal = encodeSrgb(toneMap(kToneCurve, range.scale * radiance));
    const uvec3 code = uvec3(255.0 * signal + 0.5);
    display[pixel] = code.r | code.g << 8u | code.b << 16u | 0xff000000u;
}
