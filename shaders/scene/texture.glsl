// Textures: pictures in one buffer of words, and their value at a point of a triangle.
#include "lib/estimator.glsl"
#include "lib/texture_filter.glsl"
#include "shared/bindings.h"
#include "shared/texture.h"

layout(set = 0, binding = BINDING_PICTURES) uniform utextureBuffer pictures;
layout(set = 0, binding = BINDING_TEXTURES) uniform utextureBuffer textures; // kTextureTexels each
layout(set = 0, binding = BINDING_TRIANGLE_UVS) uniform utextureBuffer triangleUvs;

TextureRecord fetchTexture(uint index) {
    const int texel = int(index * kTextureTexels);
    const uvec4 a = texelFetch(textures, texel);
    const uvec4 b = texelFetch(textures, texel + 1);
    const uvec4 c = texelFetch(textures, texel + 2);
    return TextureRecord(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), b.w, c.x, c.y, c.z, c.w);
}

TriangleUvs fetchTriangleUvs(uint texel) {
    const vec4 a = uintBitsToFloat(texelFetch(triangleUvs, int(texel)));
    const vec4 b = uintBitsToFloat(texelFetch(triangleUvs, int(texel + 1u)));
    return TriangleUvs(a.xy, a.zw, b.xy, b.zw);
}

// Words of a texel lie in one element: pictures start with an element, and texels have one word or two.
vec4 fetchPictureTexel(TextureRecord t, ivec2 at) {
    const bool is16Bit = (t.flags & kTexture16Bit) != 0u;
    const uint word = t.firstWord + (uint(at.y) * t.width + uint(at.x)) * (is16Bit ? 2u : 1u);
    const uvec4 element = texelFetch(pictures, int(word >> 2u));
    const uvec2 pair = (word & 2u) != 0u ? element.zw : element.xy;
    return texelValue((word & 1u) != 0u ? pair.yy : pair, t.flags);
}

// Texels are decoded before they are mixed.
vec4 filteredTexture(TextureRecord t, vec2 uv) {
    const TexelFootprint f = texelFootprint(uv, uvec2(t.width, t.height), t.flags);
    const vec4 above =
        mix(fetchPictureTexel(t, f.first), fetchPictureTexel(t, ivec2(f.second.x, f.first.y)), f.share.x);
    const vec4 below =
        mix(fetchPictureTexel(t, ivec2(f.first.x, f.second.y)), fetchPictureTexel(t, f.second), f.share.x);
    return mix(above, below, f.share.y);
}

// One of the four texels, with the probability of its share; u uniform in [0, 1)^2.
vec4 drawnTexture(TextureRecord t, vec2 uv, vec2 u) {
    const TexelFootprint f = texelFootprint(uv, uvec2(t.width, t.height), t.flags);
    return fetchPictureTexel(t, mix(f.first, f.second, lessThan(u, f.share)));
}

// Where a point of a triangle lies in the texture; barycentrics b.
vec2 textureCoordinates(TextureRecord t, SurfaceId surface, vec3 b) {
    const TriangleUvs corners = fetchTriangleUvs(attributeIndex(surface) * t.uvTexels + t.uvTexel);
    const vec3 uv = vec3(b.x * corners.uv0 + b.y * corners.uv1 + b.z * corners.uv2, 1.0);
    return vec2(dot(t.uRow, uv), dot(t.vRow, uv));
}

vec4 textureAt(uint index, SurfaceId surface, vec3 b) {
    const TextureRecord t = fetchTexture(index);
    return filteredTexture(t, textureCoordinates(t, surface, b));
}

// As the estimator's settings ask: bilinear, or one texel of it.
vec4 textureAt(uint index, SurfaceId surface, vec3 b, vec2 u) {
    const TextureRecord t = fetchTexture(index);
    const vec2 uv = textureCoordinates(t, surface, b);
    return kTextureFilter == kTextureFilterStochastic ? drawnTexture(t, uv, u) : filteredTexture(t, uv);
}

// Where a slot's texture lies, if textureSlots says that there is one.
uint textureIndex(uint firstTexture, uint textureSlots, uint slot) {
    return firstTexture + uint(bitCount(textureSlots & ((1u << slot) - 1u)));
}

bool hasTexture(uint textureSlots, uint slot) {
    return (textureSlots >> slot & 1u) != 0u;
}
