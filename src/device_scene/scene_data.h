// A scene in the layout of the device, before any of it is uploaded.
#pragma once

#include <cstdint>
#include <vector>

#include "accel/bvh.h"
#include "device_scene/gpu_textures.h"
#include "light/environment.h"
#include "light/lights.h"
#include "scene/scene.h"
#include "shared/bvh.h"
#include "shared/scene.h"

namespace lavalight {

struct SceneData {
    Bvh bvh;
    std::vector<LeafTriangle> leafTriangles;
    std::vector<TriangleNormals> normals;
    std::vector<MaterialRecord> materials;
    std::vector<LightRecord> lights;
    std::vector<PunctualRecord> punctuals;
    std::vector<LightTreeRecord> lightTree;
    // Empty where the scene has no such feature:
    PackedTextures textures;
    std::vector<TriangleUvs> uvs;
    std::vector<TriangleColors> colors;
    std::vector<TriangleTangents> tangents;
    std::vector<glm::vec4> environmentMap; // per cell of light/environment.h
    std::vector<EnvironmentQuad> environmentQuads;
    uint32_t features; // kFeature...
};

// Builds the BVH and packs everything; no device is needed. `lights` are the scene's. Throws Error for more
// triangles than memory could hold.
[[nodiscard]] SceneData packScene(const Scene& scene, const Lights& lights);
// With its own environment, and lights picked by power.
[[nodiscard]] SceneData packScene(const Scene& scene);

} // namespace lavalight
