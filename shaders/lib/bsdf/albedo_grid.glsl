// Where the table of directional albedos (scene/albedo_table.glsl) has its entries: columns follow the angle, rows the
// roughness. Places are real numbers, entry i lies at i.
//
// The albedo of GGX falls where cosine and alpha are alike, so that its columns do too: they are even in s (1 + k) / (s + k)
// with s = sqrt(cosine), k = 2 roughness. That ridge then stays in its columns from row to row. (On columns even in s,
// interpolation between the smoothest rows was off by 0.007.)
#ifndef LAVALIGHT_ALBEDO_GRID_GLSL
#define LAVALIGHT_ALBEDO_GRID_GLSL

#include "shared/scene.h"

const float kLastAlbedoColumn = float(kAlbedoCosines - 1u);
const float kLastAlbedoRow = float(kAlbedoRoughnesses - 1u);

float albedoRow(float roughness, float least) {
    return clamp((roughness - least) / (1.0 - least), 0.0, 1.0) * kLastAlbedoRow;
}

float roughnessOfRow(float row, float least) {
    return least + row / kLastAlbedoRow * (1.0 - least);
}

// Place of a cosine among the columns of the GGX lobe.
float specularColumn(float cosTheta, float roughness) {
    const float s = sqrt(clamp(cosTheta, 0.0, 1.0));
    const float k = 2.0 * roughness;
    return s * (1.0 + k) / (s + k) * kLastAlbedoColumn;
}

float cosineOfSpecularColumn(float column, float roughness) {
    const float k = 2.0 * roughness;
    const float u = column / kLastAlbedoColumn;
    const float s = u * k / (1.0 + k - u);
    return s * s;
}

// Place of a cosine among the columns of sheen, which grows fast towards the horizon.
float sheenColumn(float cosTheta) {
    return sqrt(clamp(cosTheta, 0.0, 1.0)) * kLastAlbedoColumn;
}

float cosineOfSheenColumn(float column) {
    return column * column / (kLastAlbedoColumn * kLastAlbedoColumn);
}

#endif
