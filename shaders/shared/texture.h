// Textures and what triangles carry for them, as the kernels read them; the host fills the same structs.
#ifndef LAVALIGHT_SHARED_TEXTURE_H
#define LAVALIGHT_SHARED_TEXTURE_H

#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// A texture, three texels. A material's textures lie in the order of their slots.
struct TextureRecord {
    vec3 uRow; // u = dot(uRow, (u, v, 1)) of the corners' coordinates, v alike
    uint flags;
    vec3 vRow;
    uint firstWord; // first word of its picture; a multiple of 4
    uint width;     // texels
    uint height;
    uint uvTexel;  // first texel of its coordinates among a triangle's
    uint uvTexels; // texels of a triangle's coordinates, over all sets
};
SHARED_CONST uint kTextureTexels = 3u;
//   flags:  | wrap of u (2 bits, lowest) | wrap of v (2 bits) | kTexture... |
SHARED_CONST uint kWrapRepeat = 0u; // what C++'s Wrap says
SHARED_CONST uint kWrapMirror = 1u;
SHARED_CONST uint kWrapClamp = 2u;
SHARED_CONST uint kWrapMask = 3u;
SHARED_CONST uint kWrapVShift = 2u;
SHARED_CONST uint kTextureNearest = 16u; // else bilinear
SHARED_CONST uint kTextureSrgb = 32u;    // colour channels are sRGB signals; else linear
SHARED_CONST uint kTexture16Bit = 64u;   // two words a texel, else one

// Coordinates of one set at a triangle's corners, two texels.
struct TriangleUvs {
    vec2 uv0;
    vec2 uv1;
    vec2 uv2;
    vec2 unused;
};
SHARED_CONST uint kUvTexels = 2u;

// Linear RGBA at a triangle's corners, 16-bit unsigned normalised numbers, two texels.
struct TriangleColors {
    uvec2 c0;
    uvec2 c1;
    uvec2 c2;
    uvec2 unused;
};
SHARED_CONST uint kColorTexels = 2u;

// Tangents at a triangle's corners, octahedral, and the signs of their bitangents, one texel.
struct TriangleTangents {
    uint t0;
    uint t1;
    uint t2;
    uint flags; // bit i: the bitangent at corner i is -cross(n, t)
};
SHARED_CONST uint kNoTangents = 8u; // in flags: the mesh has none

LAVALIGHT_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(lavalight::TextureRecord) == 16 * lavalight::kTextureTexels);
static_assert(sizeof(lavalight::TriangleUvs) == 16 * lavalight::kUvTexels);
static_assert(sizeof(lavalight::TriangleColors) == 16 * lavalight::kColorTexels);
static_assert(sizeof(lavalight::TriangleTangents) == 16);
#endif

#endif
