// Scene records as the kernels read them; the host fills the same structs.
#ifndef LAVALIGHT_SHARED_SCENE_H
#define LAVALIGHT_SHARED_SCENE_H

#include "shared/bvh.h"
#include "shared/types.h"

LAVALIGHT_SHARED_BEGIN

// The material word of a leaf triangle (shared/bvh.h): the index in the low bits, flags above. Bit 31 is kNeverCulledBit.
SHARED_CONST uint kMaterialMask = 0x3fffffffu;
SHARED_CONST uint kFlatBit = 0x40000000u; // shaded with its geometric normal

// One texel a triangle: shading normals at its corners, octahedral, two 16-bit signed normalised numbers each.
struct TriangleNormals {
    uint n0;
    uint n1;
    uint n2;
    uint unused;
};

// Four texels a material; the members mean what those of C++'s Material mean.
struct MaterialRecord {
    vec3 baseColor;
    float metallic;
    vec3 emission;
    float roughness;
    vec3 specularColor;
    float specular;
    float ior;
    uint doubleSided;
    uint unused0;
    uint unused1;
};

// One texel an emissive triangle: its column of the alias table, and where its positions are.
struct EmitterRecord {
    float probability; // of staying in this column
    uint alias;        // the other emitter of this column
    float pmf;         // with which the whole table picks this emitter
    uint leafTriangle;
};

// Directional albedo of the GGX lobe, tabulated over (sqrt(cosine), roughness); a row ends with its cosine-weighted average.
SHARED_CONST uint kAlbedoCosines = 64u;
SHARED_CONST uint kAlbedoRoughnesses = 32u;
SHARED_CONST uint kAlbedoRow = kAlbedoCosines + 1u;

LAVALIGHT_SHARED_END

#endif
