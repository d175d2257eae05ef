// Runs the estimators of the lab's kernels on the device.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "gpu/kernel.h"
#include "lab/lab_device.h"
#include "lab/moments.h"
#include "render/settings.h"
#include "shared/lab.h"

namespace lavalight {

// Most samples of one run: 65,535 groups of 64 invocations with kSamplesEach samples, rounded down.
constexpr uint64_t kMostLabSamples = uint64_t{1} << 29;

class SampleKernel {
  public:
    // `name` is a kernel that includes scene/lab_estimator.glsl. What `lab` refers to must outlive this.
    SampleKernel(const LabDevice& lab, std::string_view name, Sampler sampler = Sampler::independent);

    // Moments of `samples` (1 to kMostLabSamples) independent samples. run.seed, kind, variant, count, a and
    // b say what is sampled; the rest is filled in. `table` is for kernels that read one.
    [[nodiscard]] Moments estimate(LabRun run, uint64_t samples, std::span<const float> table = {}) const;

    // Moments of `samplesPerStream` samples (a power of two) for each of `streams` sequences.
    [[nodiscard]] std::vector<Moments> streams(LabRun run, uint32_t streams, uint32_t samplesPerStream) const;

  private:
    [[nodiscard]] std::vector<Moments> dispatch(LabRun run, std::span<const float> table) const;

    LabDevice lab_;
    gpu::Kernel kernel_;
};

} // namespace lavalight
