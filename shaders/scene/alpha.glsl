// Surfaces that let rays through: alpha as coverage, glTF's modes MASK and BLEND. A ray passes or is stopped by chance,
// triangle by triangle, which is no scattering.
#include "lib/features.glsl"
#include "lib/sampling/sampler.glsl"
#include "scene/material_record.glsl"
#include "scene/texture.glsl"
#include "scene/triangle_record.glsl"
#include "scene/vertex_color.glsl"
#include "shared/scene.h"

// Probability that a ray is stopped at barycentrics b of a triangle that has kAlphaBit.
float coverageAt(TriangleRecord triangle, vec3 b) {
    const uint material = triangle.material & kMaterialMask;
    const uint textureSlots = materialTexel(material, 3u).w;
    const uvec4 factors = materialTexel(material, 4u);
    float alpha = uintBitsToFloat(factors.y);
    if (sceneHas(kFeatureVertexColors))
        alpha *= vertexColor(triangle.surface, b).a;
    if (sceneHas(kFeatureTextures) && hasTexture(textureSlots, kSlotBaseColor))
        alpha *= textureAt(factors.x, triangle.surface, b).a; // the first slot is the first texture
    const float cutoff = uintBitsToFloat(factors.z);
    return cutoff < 0.0 ? alpha : alpha < cutoff ? 0.0 : 1.0;
}

// What a ray's decisions hash, next to the triangle; dimension: kDimensionAlpha or kDimensionShadowAlpha.
uint alphaSeed(SampleKey key, uint dimension) {
    return sceneHas(kFeatureAlpha) ? pcg4d(uvec4(key.pixel, key.index, key.vertex << 8u | dimension, key.seed)).x : 0u;
}

// All records of a triangle get one answer, by its surface.
bool letsThrough(TriangleRecord triangle, vec3 b, uint seed) {
    const uvec2 words = hashWords(triangle.surface);
    return bitsToUnit(pcg4d(uvec4(seed, words.x, 0xa1fau, words.y)).x) >= coverageAt(triangle, b);
}
