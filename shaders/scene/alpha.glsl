// Surfaces that let rays through: alpha as coverage, glTF's modes MASK and BLEND. A ray passes or is stopped by chance,
// triangle by triangle, which is no scattering.
#include "lib/features.glsl"
#include "lib/sampling/sampler.glsl"
#include "scene/leaf_triangle.glsl"
#include "scene/material_record.glsl"
#include "scene/texture.glsl"
#include "scene/vertex_color.glsl"
#include "shared/scene.h"

// Probability that a ray is stopped at barycentrics b of a triangle that has kAlphaBit.
float coverageAt(LeafTriangle triangle, vec3 b) {
    const uint material = triangle.material & kMaterialMask;
    const uint textureSlots = materialTexel(material, 3u).w;
    const uvec4 factors = materialTexel(material, 4u);
    float alpha = uintBitsToFloat(factors.y);
    if (sceneHas(kFeatureVertexColors))
        alpha *= vertexColor(triangle.triangle, b).a;
    if (sceneHas(kFeatureTextures) && hasTexture(textureSlots, kSlotBaseColor))
        alpha *= textureAt(factors.x, triangle.triangle, b).a; // the first slot is the first texture
    const float cutoff = uintBitsToFloat(factors.z);
    return cutoff < 0.0 ? alpha : alpha < cutoff ? 0.0 : 1.0;
}

// What a ray's decisions hash, next to the triangle; dimension: kDimensionAlpha or kDimensionShadowAlpha.
uint alphaSeed(SampleKey key, uint dimension) {
    return pcg4d(uvec4(key.pixel, key.index, key.vertex << 8u | dimension, key.seed)).x;
}

// Parts of a triangle may lie in several leaves: they all get one answer, by its id.
bool letsThrough(LeafTriangle triangle, vec3 b, uint seed) {
    return bitsToUnit(pcg4d(uvec4(seed, triangle.triangle, 0xa1fau, 0u)).x) >= coverageAt(triangle, b);
}
