// The materials that the device tests of the BSDF run over.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/kernel.h"
#include "shared/scene.h"

namespace lavalight::test {

struct TestMaterial {
    std::string name;
    MaterialRecord record;
};

// Rough materials: `alpha` = roughness^2 >= 0.04, so that lobes are wide enough for bins.
[[nodiscard]] std::vector<TestMaterial> roughMaterials();
// Mirrors alone and over a diffuse base (metals first), and a surface too smooth for bins.
[[nodiscard]] std::vector<TestMaterial> smoothMaterials();

// Anisotropy, layers and films, rough and opaque.
[[nodiscard]] std::vector<TestMaterial> layeredMaterials();
// Clearcoats whose normal leans to x by the slope clearcoatNormalScale, as the test kernels take it.
[[nodiscard]] std::vector<TestMaterial> tiltedCoats();
// Rough transmissive materials without an inside: alike from both sides.
[[nodiscard]] std::vector<TestMaterial> transmissiveMaterials();
// Rough boundaries of glass bodies.
[[nodiscard]] std::vector<TestMaterial> solidMaterials();
// Rough lobes beside smooth ones.
[[nodiscard]] std::vector<TestMaterial> smoothLayers();
// Nothing but smooth lobes.
[[nodiscard]] std::vector<TestMaterial> smoothFilms();
// White materials at roughnesses between the rows of the albedo table, from a mirror on.
[[nodiscard]] std::vector<TestMaterial> whitesOfAllRoughnesses();

// Materials and the albedo table on the device, under the names of scene/material.glsl.
class MaterialBuffers {
  public:
    MaterialBuffers(gpu::Device& device, std::span<const TestMaterial> materials);
    [[nodiscard]] gpu::ResourceTable resources() const;

  private:
    gpu::Buffer records_;
    gpu::Buffer albedoTable_;
};

} // namespace lavalight::test
