// Which texels a texture shows at a point, in what shares, and texels as numbers.
// Based on: OpenGL 4.6, section 8.14 (wrap modes and filters, which glTF 2.0 refers to); IEC 61966-2-1 (sRGB).
#include "shared/texture.h"

// Two columns and two rows of texels; the share of the second ones.
struct TexelFootprint {
    ivec2 first;
    ivec2 second;
    vec2 share;
};

// The coordinate moved into the first periods, where its product with the texture's size keeps its fraction; beyond
// the borders of a clamped texture all texels are alike.
float reduceCoordinate(float u, uint wrap) {
    const float periods = wrap == kWrapMirror ? 2.0 * floor(0.5 * u) : floor(u);
    return wrap == kWrapClamp ? clamp(u, -1.0, 2.0) : u - periods;
}

// The texel's column or row within the picture, for one of a reduced coordinate or its neighbour. NaN leads into the picture
// too.
int wrapTexel(int i, int size, uint wrap) {
    const int period = wrap == kWrapMirror ? 2 * size : size;
    int inPeriod = i < 0 ? i + period : i;
    inPeriod = inPeriod >= period ? inPeriod - period : inPeriod;
    const int mirrored = inPeriod >= size ? period - 1 - inPeriod : inPeriod;
    return clamp(wrap == kWrapClamp ? i : mirrored, 0, size - 1);
}

// Texel centres lie at half integers.
TexelFootprint texelFootprint(vec2 uv, uvec2 size, uint flags) {
    const uint wrapU = flags & kWrapMask;
    const uint wrapV = (flags >> kWrapVShift) & kWrapMask;
    const bool isNearest = (flags & kTextureNearest) != 0u;
    const vec2 reduced = vec2(reduceCoordinate(uv.x, wrapU), reduceCoordinate(uv.y, wrapV));
    const vec2 p = reduced * vec2(size) - (isNearest ? 0.0 : 0.5);
    const ivec2 low = ivec2(floor(p));
    const ivec2 high = isNearest ? low : low + 1;
    TexelFootprint footprint;
    footprint.first = ivec2(wrapTexel(low.x, int(size.x), wrapU), wrapTexel(low.y, int(size.y), wrapV));
    footprint.second = ivec2(wrapTexel(high.x, int(size.x), wrapU), wrapTexel(high.y, int(size.y), wrapV));
    footprint.share = isNearest ? vec2(0.0) : p - floor(p);
    return footprint;
}

vec3 srgbToLinear(vec3 v) {
    return mix(pow((v + 0.055) / 1.055, vec3(2.4)), v / 12.92, lessThanEqual(v, vec3(0.04045)));
}

// A texel of one word, or of both of them.
vec4 texelValue(uvec2 words, uint flags) {
    const bool is16Bit = (flags & kTexture16Bit) != 0u;
    const vec4 v = is16Bit ? vec4(unpackUnorm2x16(words.x), unpackUnorm2x16(words.y)) : unpackUnorm4x8(words.x);
    return vec4((flags & kTextureSrgb) != 0u ? srgbToLinear(v.rgb) : v.rgb, v.a);
}
