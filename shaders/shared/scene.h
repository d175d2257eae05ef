// Scene records as the kernels read them; the host fills the same structs.
#ifndef LAVALIGHT_SHARED_SCENE_H
#define LAVALIGHT_SHARED_SCENE_H

#include "shared/triangle.h"
#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// The material word of a triangle (shared/triangle.h): the index in the low bits, flags above. Bit 31 is kNeverCulledBit.
SHARED_CONST uint kMaterialMask = 0x0fffffffu;
SHARED_CONST uint kOwnPlaneBit = 0x10000000u; // rays start on the triangle, not on the smooth surface above it
SHARED_CONST uint kAlphaBit = 0x20000000u; // rays may pass through: by alpha
SHARED_CONST uint kFlatBit = 0x40000000u; // shaded with its geometric normal

// The smooth surface that a mesh stands for (lib/math/smooth_surface.glsl): a corner's normal lifts nothing where its cosine with
// the triangle's is lower; lower than this share of the longest edge, a lift may be the rounding of packed normals.
SHARED_CONST float kLeastTrustedCosine = 0.6f;
SHARED_CONST float kLeastLift = 5e-5f;

// One texel a triangle: shading normals at its corners, octahedral, two 16-bit signed normalised numbers each.
struct TriangleNormals {
    uint n0;
    uint n1;
    uint n2;
    uint solid; // number of the solid that it bounds, from 1 on; else 0
};

// Two texels a solid: what it is filled with. Record 0 is the space outside all of them. Where solids overlap, the medium is
// that of the lowest number.
struct SolidRecord {
    vec3 attenuation; // absorption per metre
    float ior;
    float dispersion;
    float unused[3];
};
SHARED_CONST uint kSolidTexels = 2u;

// Eleven texels a material; the members mean what those of C++'s Material mean. 0 turns a lobe off.
struct MaterialRecord {
    vec3 baseColor;
    float metallic;
    vec3 emission;
    float roughness;
    vec3 specularColor;
    float specular;
    float ior;
    float transmission;
    uint flags;        // kMaterial...
    uint textureSlots; // bit i: slot i has a texture
    uint firstTexture; // index of the first of its textures, which lie in the order of their slots
    float alpha;
    float alphaCutoff; // below 0: the alpha itself is the probability of being hit
    float normalScale;
    vec3 attenuation; // absorption per metre of the inside of a solid
    float dispersion;
    float clearcoat;
    float clearcoatRoughness;
    float clearcoatNormalScale;
    float anisotropy;
    vec3 sheenColor;
    float sheenRoughness;
    float anisotropyRotation;
    float iridescence;
    float iridescenceIor;
    float iridescenceThicknessMinimum;
    float iridescenceThicknessMaximum; // after texturing: the thickness
    float diffuseTransmission;
    uint coatTangents;       // first of the tangents that the clearcoat's normal texture goes by; 0 for all but rare files
    uint anisotropyTangents; // of those that the anisotropy texture goes by
    vec3 diffuseTransmissionColor;
    float unusedLast;
};
SHARED_CONST uint kMaterialTexels = 11u;
SHARED_CONST uint kMaterialDoubleSided = 1u;
SHARED_CONST uint kMaterialSolid = 2u; // the boundary of a refracting body; else a transmissive surface is a thin wall
SHARED_CONST uint kMaterialUnlit = 4u;
SHARED_CONST uint kMaterialGlossiness = 8u; // the alpha of kSlotSpecularColor's texture multiplies 1 - roughness

// Slots of textures: what C++'s TextureSlot says.
SHARED_CONST uint kSlotBaseColor = 0u;
SHARED_CONST uint kSlotMetallicRoughness = 1u;
SHARED_CONST uint kSlotNormal = 2u;
SHARED_CONST uint kSlotEmission = 3u;
SHARED_CONST uint kSlotSpecular = 4u;
SHARED_CONST uint kSlotSpecularColor = 5u;
SHARED_CONST uint kSlotTransmission = 6u;
SHARED_CONST uint kSlotClearcoat = 7u;
SHARED_CONST uint kSlotClearcoatRoughness = 8u;
SHARED_CONST uint kSlotClearcoatNormal = 9u;
SHARED_CONST uint kSlotSheenColor = 10u;
SHARED_CONST uint kSlotSheenRoughness = 11u;
SHARED_CONST uint kSlotAnisotropy = 12u;
SHARED_CONST uint kSlotIridescence = 13u;
SHARED_CONST uint kSlotIridescenceThickness = 14u;
SHARED_CONST uint kSlotDiffuseTransmission = 15u;
SHARED_CONST uint kSlotDiffuseTransmissionColor = 16u;

// One texel a light: its column of the alias table, and what it is. Lights of the tree have no column of their own; the
// tree as a whole has one, after those of all other lights.
struct LightRecord {
    float probability; // probability of staying in this column
    uint alias;        // the other light of this column; of a light in the tree: bit i is set where its path leads into
                       // the second child, i levels below the root
    float pmf;         // probability that the whole table picks this light, or the tree that it is in
    uint source;       // kind in the top two bits; below: triangle record, or index of the punctual light
};
SHARED_CONST uint kNoLight = 0xffffffffu;
SHARED_CONST uint kLightKindShift = 30u;
SHARED_CONST uint kLightIndexMask = 0x3fffffffu;
SHARED_CONST uint kLightTriangle = 0u;
SHARED_CONST uint kLightPunctual = 1u;
SHARED_CONST uint kLightEnvironment = 2u;
SHARED_CONST uint kLightTree = 3u; // no light itself

// Three texels a node of the light tree: what its lights may send where. The root is node 0. Children are kLightTreeWidth
// neighbours; those that are missing are leaves without intensity.
struct LightTreeRecord {
    vec3 center; // centre of a sphere around all lights
    float radius;
    uint axis;       // axis of the cone of normals, octahedral
    uint cosines;    // cosine of the cone's half angle, and of the angle around each normal within which light leaves: snorm 2x16
    float intensity; // W/sr along the normals, of all lights together
    uint reference;  // flags, and the light, or the first child
    float inverseRange2; // 1 / range^2 of the light that reaches furthest; 0: without end
    float unused[3];
};
SHARED_CONST uint kLightTreeTexels = 3u;
SHARED_CONST uint kLightTreeWidth = 8u;
SHARED_CONST uint kLightTreeChildBits = 3u; // of a path to a light, for each level
SHARED_CONST uint kLightTreeLeafBit = 0x80000000u;
SHARED_CONST uint kLightTreeTwoSidedBit = 0x40000000u; // light leaves against the normals too
SHARED_CONST uint kLightTreeIndexMask = 0x3fffffffu;

// Four texels a light of KHR_lights_punctual.
struct PunctualRecord {
    vec3 position;
    uint kind;      // kPunctual...
    vec3 direction; // unit length, the way the light shines
    float coneScale;  // spot: (cos(angle) * scale + offset)^2, clamped to [0, 1]
    vec3 intensity; // W/sr; directional: W/m^2
    float coneOffset;
    float inverseRange2; // 1 / range^2; 0: without end
    float unused[3];
};
SHARED_CONST uint kPunctualTexels = 4u;
SHARED_CONST uint kPunctualPoint = 0u;
SHARED_CONST uint kPunctualSpot = 1u;
SHARED_CONST uint kPunctualDirectional = 2u;

// Below this alpha (= roughness^2) a lobe is a mirror, or a pane: at 1e-3 it is 0.1 degrees wide, and D's peak of
// 1 / (pi alpha^2) would cost more noise than the width is worth.
SHARED_CONST float kSmoothAlpha = 1e-3f;

// Directional albedos of the GGX lobe and of sheen, tabulated over angle and roughness (lib/bsdf/albedo_grid.glsl), row by row;
// then the cosine-weighted averages of the GGX lobe's, kAveragesPerRow to the distance of two rows.
SHARED_CONST uint kAlbedoCosines = 64u;
SHARED_CONST uint kAlbedoRoughnesses = 32u;
SHARED_CONST uint kAveragesPerRow = 4u;
SHARED_CONST uint kAlbedoEntries = kAlbedoCosines * kAlbedoRoughnesses;
SHARED_CONST uint kAlbedoAverages = kAveragesPerRow * (kAlbedoRoughnesses - 1u) + 1u;
SHARED_CONST float kLeastTabulatedRoughness = 0.0316227766f; // alpha is kSmoothAlpha; smooth lobes ask for no table

LAVALIGHT_SHARED_END

#ifdef __cplusplus
static_assert(sizeof(lavalight::SolidRecord) == 16 * lavalight::kSolidTexels);
static_assert(sizeof(lavalight::MaterialRecord) == 16 * lavalight::kMaterialTexels);
#endif

#endif
