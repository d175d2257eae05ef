#include "inspect/ray_tracer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <limits>
#include <string_view>

#include "base/parallel.h"
#include "device_scene/scene_features.h"
#include "gpu/buffer.h"
#include "hosted/host_rays.h"
#include "kernels/kernel_source.h"
#include "shared/frame.h"

namespace lavalight {
namespace {

gpu::Kernel makeKernel(const gpu::Device& device, std::string_view file, AcceleratorKind accelerator,
                       bool countsVisits) {
    // No features: all surfaces are opaque to these rays.
    const auto [first, second] = featureConstants(0);
    const std::array<gpu::SpecialisationConstant, 3> constants{
        {{CONSTANT_COUNT_VISITS, countsVisits ? 1u : 0u}, first, second}};
    return {device, embeddedKernel(textOf({file, kernelAccelerator(accelerator)})), constants};
}

} // namespace

RayTracer::RayTracer(gpu::Device& device, const GpuScene& scene, bool countsVisits)
    : device_(&device), scene_(&scene),
      visits_(device, "visit counts", sizeof(VisitCounts), gpu::BufferUse::readback) {
    if (scene.accelerator().embree() != nullptr)
        return;
    closest_ = makeKernel(device, "trace_closest", scene.accelerator().kind(), countsVisits);
    any_ = makeKernel(device, "trace_any", scene.accelerator().kind(), countsVisits);
}

// Answers trace(rays, ray) for each ray, on all processors.
template <typename Answer, typename GivenRay, typename Trace>
std::vector<Answer> RayTracer::byHost(std::span<const GivenRay> rays, const Trace& trace) {
    constexpr size_t kTogether = 4096;
    const auto start = std::chrono::steady_clock::now();
    const HostScene scene = hostScene(*scene_, 0); // all surfaces are opaque to these rays
    WaveRange range{};
    range.pixelCount = range.sampleCount = 1;
    std::vector<Answer> answers(rays.size());
    forEachInParallel((rays.size() + kTogether - 1) / kTogether, [&](size_t part) {
        HostRays host(scene, {}, range);
        const size_t end = std::min(rays.size(), (part + 1) * kTogether);
        for (size_t i = part * kTogether; i < end; ++i)
            answers[i] = trace(host, rays[i]);
    });
    lastSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return answers;
}

size_t RayTracer::maxRays() const {
    return std::min<size_t>(size_t{device_->limits().maxGroups} * kWorkgroupSize,
                            device_->limits().maxStorageBufferBytes / sizeof(ShadowRay));
}

std::vector<TracedHit> RayTracer::closest(std::span<const Ray> rays) {
    if (!closest_)
        return byHost<TracedHit>(rays, [](HostRays& host, Ray ray) {
            const Hit hit = host.trace(0, 1, ray);
            const bool isMet = hit.t < std::numeric_limits<float>::infinity();
            return TracedHit{hit.t, isMet ? SurfaceId{hit.record} : kNoSurface};
        });
    gpu::Buffer in(*device_, "rays", rays.size_bytes(), gpu::BufferUse::storage);
    const gpu::Buffer out(*device_, "hits", rays.size() * sizeof(TracedHit), gpu::BufferUse::storage);
    in.upload(rays);
    gpu::ResourceTable resources;
    scene_->addTo(resources);
    resources.set("Rays", in);
    resources.set("TracedHits", out);
    run(*closest_, resources, rays.size());
    return out.downloadAll<TracedHit>();
}

std::vector<uint32_t> RayTracer::occluded(std::span<const ShadowRay> rays) {
    if (!any_)
        return byHost<uint32_t>(
            rays, [](HostRays& host, const ShadowRay& ray) { return host.isOccluded(ray, 0, 0) ? 1u : 0u; });
    gpu::Buffer in(*device_, "shadow rays", rays.size_bytes(), gpu::BufferUse::storage);
    const gpu::Buffer out(*device_, "shadow flags", rays.size() * sizeof(uint32_t), gpu::BufferUse::storage);
    in.upload(rays);
    gpu::ResourceTable resources;
    scene_->addTo(resources);
    resources.set("ShadowRays", in);
    resources.set("Occluded", out);
    run(*any_, resources, rays.size());
    return out.downloadAll<uint32_t>();
}

void RayTracer::run(const gpu::Kernel& kernel, gpu::ResourceTable resources, size_t rays) {
    assert(rays <= maxRays());
    resources.set("Visits", visits_);
    const gpu::BoundKernel bound(*device_, kernel, resources);
    gpu::Commands commands(*device_);
    commands.begin();
    commands.fill(visits_, 0);
    commands.dispatch(bound, static_cast<uint32_t>((rays + kWorkgroupSize - 1) / kWorkgroupSize));
    commands.submitAndWait();
    const auto time = commands.times().find(kernel.name());
    lastVisits_ = visits_.downloadAll<VisitCounts>().front();
    lastSeconds_ = time == commands.times().end() ? 0.0 : time->second.seconds;
}

} // namespace lavalight
