#version 460
// Writes each shared struct with its members counted upwards, into the second element of an array: what the scene loads
// through texel buffers is passed on as loaded.
#include "lib/math/ray_offset.glsl"
#include "scene/light.glsl"
#include "scene/tangent_frame.glsl"
#include "scene/intersect.glsl"
#include "shared/frame.h"
#include "shared/trace.h"
#include "shared/wavefront.h"

layout(local_size_x = 1) in;
layout(set = 0, binding = 40, std430) writeonly buffer RayOut { Ray ray[]; };
layout(set = 0, binding = 41, std430) writeonly buffer HitOut { Hit hit[]; };
layout(set = 0, binding = 42, std430) writeonly buffer PathOut { Path path[]; };
layout(set = 0, binding = 43, std430) writeonly buffer ShadowRayOut { ShadowRay shadowRay[]; };
layout(set = 0, binding = 44, std430) writeonly buffer BounceCountersOut { BounceCounters bounceCounters[]; };
layout(set = 0, binding = 45, std430) writeonly buffer DispatchSizeOut { DispatchSize dispatchSize[]; };
layout(set = 0, binding = 46, std430) writeonly buffer WaveRangeOut { WaveRange waveRange[]; };
layout(set = 0, binding = 47, std430) writeonly buffer FrameParametersOut { FrameParameters frameParameters[]; };
layout(set = 0, binding = 48, std430) writeonly buffer BvhNodeOut { BvhNode bvhNode[]; };
layout(set = 0, binding = 49, std430) writeonly buffer TriangleRecordOut { TriangleRecord triangleRecord[]; };
layout(set = 0, binding = 50, std430) writeonly buffer TriangleNormalsOut { TriangleNormals normals[]; };
layout(set = 0, binding = 51, std430) writeonly buffer MaterialRecordOut { MaterialRecord material[]; };
layout(set = 0, binding = 52, std430) writeonly buffer LightRecordOut { LightRecord light[]; };
layout(set = 0, binding = 54, std430) writeonly buffer PunctualRecordOut { PunctualRecord punctual[]; };
layout(set = 0, binding = 55, std430) writeonly buffer LightTreeRecordOut { LightTreeRecord lightTreeNode[]; };
layout(set = 0, binding = 56, std430) writeonly buffer TextureRecordOut { TextureRecord textureRecord[]; };
layout(set = 0, binding = 57, std430) writeonly buffer TriangleUvsOut { TriangleUvs uvs[]; };
layout(set = 0, binding = 58, std430) writeonly buffer TriangleColorsOut { TriangleColors colors[]; };
layout(set = 0, binding = 59, std430) writeonly buffer TriangleTangentsOut { TriangleTangents tangents[]; };
layout(set = 0, binding = 53, std430) writeonly buffer TracedHitOut { TracedHit tracedHit[]; };

void main() {
    ray[1] = Ray(vec3(1, 2, 3), SurfaceId(4u), vec3(5, 6, 7), 8, 9u, InteriorList(10u, 11u, 12u));
    hit[1] = Hit(1, 2u, vec2(3, 4));
    path[1] = Path(vec3(1, 2, 3), 4, vec3(5, 6, 7), 8);
    shadowRay[1] = ShadowRay(vec3(1, 2, 3), SurfaceId(4u), vec3(5, 6, 7), SurfaceId(8u), vec3(9, 10, 11), 12);
    bounceCounters[1] = BounceCounters(1u, 2u);
    dispatchSize[1] = DispatchSize(1u, 2u, 3u, 4u);
    waveRange[1] = WaveRange(1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u);
    frameParameters[1] = FrameParameters(vec3(1, 2, 3), 4u, vec3(5, 6, 7), 8u, vec3(9, 10, 11), 12u,
                                         vec3(13, 14, 15), 16u, vec3(17, 18, 19), 20u, vec3(21, 22, 23), 24, 25u, 26u, 27u,
                                         28, 29, 30u, 31u, 32u, 33u, 34u, 35, 36, 37, 38u, 39u, 40u);
    normals[1] = TriangleNormals(1u, 2u, 3u, 4u);
    tracedHit[1] = TracedHit(1, SurfaceId(2u));
    bvhNode[1] = loadNode(1u);
    triangleRecord[1] = loadTriangle(1u);
    material[1] = fetchMaterial(1u);
    light[1] = fetchLight(1u);
    punctual[1] = fetchPunctual(1u);
    lightTreeNode[1] = fetchLightTreeNode(1u);
    textureRecord[1] = fetchTexture(1u);
    uvs[1] = fetchTriangleUvs(kUvTexels);
    colors[1] = fetchTriangleColors(1u);
    tangents[1] = fetchTriangleTangents(1u);
}
