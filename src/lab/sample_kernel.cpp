#include "lab/sample_kernel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "kernels/kernel_source.h"
#include "shared/frame.h"

namespace lavalight {
namespace {

// The layouts of both languages: push constants by std430, LabMoments as three words.
static_assert(sizeof(LabRun) == 64 && offsetof(LabRun, a) == 32 && sizeof(LabMoments) == 12);

constexpr uint32_t kGroupSize = 64;
constexpr uint32_t kGroupsOfPass = 1024; // at most 16 million samples, between which the caller is asked
constexpr uint32_t kSamplesEach = 256;   // samples of an invocation, in a plain estimate
// Sequences take fewer: sums of so few floats are good to 1e-7, below the errors of Sobol's points.
constexpr uint32_t kSequenceSamplesEach = 64;

gpu::Kernel makeKernel(const gpu::Device& device, std::string_view name, Sampler sampler) {
    const std::array<gpu::SpecialisationConstant, 1> constants{
        {{CONSTANT_SAMPLER, static_cast<uint32_t>(sampler)}}};
    return {device, embeddedKernel(name), constants};
}

Moments fromDevice(const LabMoments& m) {
    return {m.mean, m.squares, m.count};
}

} // namespace

SampleKernel::SampleKernel(const LabDevice& lab, std::string_view name, Sampler sampler)
    : lab_(lab), kernel_(makeKernel(lab.device, name, sampler)) {}

Moments SampleKernel::estimate(LabRun run, uint64_t samples, std::span<const float> table) const {
    assert(samples > 0 && samples <= kMostLabSamples);
    run.sampleCount = static_cast<uint32_t>(samples);
    run.samplesEach = kSamplesEach;
    run.blocks = 1;
    return merged(dispatch(run, table));
}

std::vector<Moments> SampleKernel::streams(LabRun run, uint32_t streams, uint32_t samplesPerStream) const {
    assert(uint64_t{streams} * samplesPerStream <= kMostLabSamples);
    run.samplesEach = std::min(kSequenceSamplesEach, samplesPerStream);
    run.blocks = samplesPerStream / run.samplesEach;
    run.sampleCount = streams * samplesPerStream;
    assert(run.blocks * run.samplesEach == samplesPerStream);
    const std::vector<Moments> parts = dispatch(run, {});
    std::vector<Moments> result;
    for (size_t i = 0; i < parts.size(); i += run.blocks)
        result.push_back(merged(std::span(parts).subspan(i, run.blocks)));
    return result;
}

std::vector<Moments> SampleKernel::dispatch(LabRun run, std::span<const float> table) const {
    const uint32_t invocations = (run.sampleCount - 1) / run.samplesEach + 1;
    const gpu::Buffer out(lab_.device, "lab results", uint64_t{invocations} * sizeof(LabMoments),
                          gpu::BufferUse::storage);
    gpu::Buffer input(lab_.device, "lab table", table.size_bytes(), gpu::BufferUse::storage);
    input.upload(table);
    gpu::ResourceTable resources;
    resources.set("LabOut", out);
    resources.set("LabTable", input);
    const gpu::BoundKernel bound(lab_.device, kernel_, resources);
    gpu::Commands commands(lab_.device);
    for (run.first = 0; run.first < invocations; run.first += kGroupSize * kGroupsOfPass) {
        lab_.look();
        const uint32_t groups = (invocations - run.first - 1) / kGroupSize + 1;
        commands.begin();
        commands.dispatch(bound, std::min(groups, kGroupsOfPass), std::as_bytes(std::span(&run, 1)));
        commands.submitAndWait();
    }
    const std::vector<LabMoments> parts = out.downloadAll<LabMoments>();
    std::vector<Moments> result(parts.size());
    std::transform(parts.begin(), parts.end(), result.begin(), fromDevice);
    return result;
}

} // namespace lavalight
