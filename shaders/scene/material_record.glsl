// Materials as they lie in memory.
#include "lib/features.glsl"
#include "shared/bindings.h"
#include "shared/scene.h"

layout(set = 0, binding = BINDING_MATERIALS) uniform utextureBuffer materials;

uvec4 materialTexel(uint index, uint texel) {
    return texelFetch(materials, int(kMaterialTexels * index + texel));
}

// Members that no feature of the scene asks for are 0.
MaterialRecord fetchMaterial(uint index) {
    const uvec4 a = materialTexel(index, 0u);
    const uvec4 b = materialTexel(index, 1u);
    const uvec4 c = materialTexel(index, 2u);
    const uvec4 d = materialTexel(index, 3u);
    const uvec4 e = sceneHas(kFeatureTextures) || sceneHas(kFeatureAlpha) ? materialTexel(index, 4u) : uvec4(0u);
    const uvec4 f = sceneHas(kFeatureAttenuation) || sceneHas(kFeatureDispersion) ? materialTexel(index, 5u) : uvec4(0u);
    const uvec4 g = sceneHas(kFeatureClearcoat) || sceneHas(kFeatureAnisotropy) ? materialTexel(index, 6u) : uvec4(0u);
    const uvec4 h = sceneHas(kFeatureSheen) ? materialTexel(index, 7u) : uvec4(0u);
    const uvec4 i = sceneHas(kFeatureAnisotropy) || sceneHas(kFeatureIridescence) ? materialTexel(index, 8u) : uvec4(0u);
    const uvec4 j =
        sceneHas(kFeatureIridescence) || sceneHas(kFeatureDiffuseTransmission) ? materialTexel(index, 9u) : uvec4(0u);
    // Asked for apart: SPIRV-Tools crashes on conditions of three features.
    const uvec2 planes = sceneHas(kFeatureTangentPlanes) ? materialTexel(index, 9u).zw : uvec2(0u);
    const uvec4 k = sceneHas(kFeatureDiffuseTransmission) ? materialTexel(index, 10u) : uvec4(0u);
    return MaterialRecord(
        uintBitsToFloat(a.xyz), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), uintBitsToFloat(b.w),
        uintBitsToFloat(c.xyz), uintBitsToFloat(c.w), uintBitsToFloat(d.x), uintBitsToFloat(d.y), d.z, d.w, e.x,
        uintBitsToFloat(e.y), uintBitsToFloat(e.z), uintBitsToFloat(e.w), uintBitsToFloat(f.xyz),
        uintBitsToFloat(f.w), uintBitsToFloat(g.x), uintBitsToFloat(g.y), uintBitsToFloat(g.z),
        uintBitsToFloat(g.w), uintBitsToFloat(h.xyz), uintBitsToFloat(h.w), uintBitsToFloat(i.x),
        uintBitsToFloat(i.y), uintBitsToFloat(i.z), uintBitsToFloat(i.w), uintBitsToFloat(j.x),
        uintBitsToFloat(j.y), planes.x, planes.y, uintBitsToFloat(k.xyz),
        uintBitsToFloat(k.w));
}
