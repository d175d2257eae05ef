// Estimators that must agree: the default with one setting changed, and every combination of settings.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "render/settings.h"
#include "scene/scene.h"

namespace lavalight::test {

// `name` is what the command line would say.
struct Variant {
    std::string name;
    EstimatorSettings settings;
    uint32_t effort = 1; // multiple of the samples that other variants take
};

// All variants have the sampler `independent`, as Z-tests suppose.
[[nodiscard]] Variant defaultVariant();

// Each setting with named values at each value that must not change the mean (by the table of settings), one
// at a time, or with another that it needs; seed 1, so that images are independent of one at seed 0. Without
// next-event estimation, the noisiest by far, effort 4.
[[nodiscard]] std::vector<Variant> singleVariants();

// The single variants that draw or weigh directions otherwise, which is where materials and meshes matter:
// none that only picks lights otherwise, and of the roulettes but that which is off and that which MIS heeds.
// Most of a variant's time goes into compiling its kernels.
[[nodiscard]] std::vector<Variant> variantsOfDirections();

// Every combination of those values that checkSettings() permits; seed 1.
[[nodiscard]] std::vector<Variant> allVariants();

// The variants whose error thousands of samples can judge on a built-in scene: not light samples alone on
// Veach's plates, whose mirror-like highlights they find so seldom that neither mean nor variance shows it.
[[nodiscard]] std::vector<Variant> answerable(const std::string& scene, std::vector<Variant> variants);

struct MeanEffort {
    uint32_t samples = 0;
    double leastShare = 0.0; // of the tiles that must be precise enough to tell two means apart
    uint32_t maxBounces = 4; // for every render: without roulette, paths would run on to 64
};

// Renders each variant with so many samples times its effort, 32 x 32 pixels, and the default with twice as
// many, whose noise counts in every comparison. Fails where a variant has another mean, or where too few
// tiles would show it. Prints a line for each variant.
void expectOneMean(gpu::Device& device, const Scene& scene, const std::vector<Variant>& variants,
                   const MeanEffort& effort);

} // namespace lavalight::test
