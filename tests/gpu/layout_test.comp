#version 460
// Passes on what the scene loads through texel buffers, as loaded.
#include "lib/math/ray_offset.glsl"
#include "scene/light.glsl"
#include "scene/media.glsl"
#include "scene/tangent_basis.glsl"
#include "scene/intersect.glsl"

layout(local_size_x = 1) in;
layout(set = 0, binding = 48, std430) writeonly buffer BvhNodeOut { BvhNode bvhNode[]; };
layout(set = 0, binding = 49, std430) writeonly buffer TriangleRecordOut { TriangleRecord triangleRecord[]; };
layout(set = 0, binding = 51, std430) writeonly buffer MaterialRecordOut { MaterialRecord material[]; };
layout(set = 0, binding = 60, std430) writeonly buffer SolidRecordOut { SolidRecord solid[]; };
layout(set = 0, binding = 52, std430) writeonly buffer LightRecordOut { LightRecord light[]; };
layout(set = 0, binding = 54, std430) writeonly buffer PunctualRecordOut { PunctualRecord punctual[]; };
layout(set = 0, binding = 55, std430) writeonly buffer LightTreeRecordOut { LightTreeRecord lightTreeNode[]; };
layout(set = 0, binding = 56, std430) writeonly buffer TextureRecordOut { TextureRecord textureRecord[]; };
layout(set = 0, binding = 57, std430) writeonly buffer TriangleUvsOut { TriangleUvs uvs[]; };
layout(set = 0, binding = 58, std430) writeonly buffer TriangleColorsOut { TriangleColors colors[]; };
layout(set = 0, binding = 59, std430) writeonly buffer TriangleTangentsOut { TriangleTangents tangents[]; };

void main() {
    bvhNode[1] = loadNode(1u);
    triangleRecord[1] = loadTriangle(1u);
    material[1] = fetchMaterial(1u);
    solid[1] = fetchSolid(1u);
    light[1] = fetchLight(1u);
    punctual[1] = fetchPunctual(1u);
    lightTreeNode[1] = fetchLightTreeNode(1u);
    textureRecord[1] = fetchTexture(1u);
    uvs[1] = fetchTriangleUvs(kUvTexels);
    colors[1] = fetchTriangleColors(1u);
    tangents[1] = fetchTriangleTangents(1u);
}
