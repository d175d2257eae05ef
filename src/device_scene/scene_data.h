// A scene in the layout of the device, before any of it is uploaded.
#pragma once

#include <cstdint>
#include <vector>

#include "device_scene/accelerator.h"
#include "device_scene/gpu_textures.h"
#include "light/environment.h"
#include "light/lights.h"
#include "scene/scene.h"
#include "shared/features.h"
#include "shared/scene.h"
#include "shared/triangle.h"

namespace lavalight {

struct SceneData {
    AcceleratorData accelerator;
    std::vector<TriangleRecord> triangles; // in the scene's numbering
    std::vector<TriangleNormals> normals;
    std::vector<MaterialRecord> materials;
    std::vector<SolidRecord> solids; // and before them the space outside
    std::vector<LightRecord> lights; // emissive triangles by their numbers in the scene, not by records
    std::vector<PunctualRecord> punctuals;
    std::vector<LightTreeRecord> lightTree;
    // Empty where the scene has no such feature:
    PackedTextures textures;
    std::vector<TriangleUvs> uvs;
    std::vector<TriangleColors> colors;
    std::vector<TriangleTangents> tangents;
    std::vector<glm::vec4> environmentMap; // per cell of light/environment.h
    std::vector<EnvironmentQuad> environmentQuads;
    SceneFeatures features = 0; // kFeature...
};

// Builds the accelerator and packs everything; no device is needed. `lights`
// are the scene's. Throws Error for more triangles than memory could hold.
[[nodiscard]] SceneData packScene(const Scene& scene, const Lights& lights,
                                  AcceleratorKind kind = AcceleratorKind::bvh8);
// With its own environment, and lights picked by power.
[[nodiscard]] SceneData packScene(const Scene& scene, AcceleratorKind kind = AcceleratorKind::bvh8);

} // namespace lavalight
