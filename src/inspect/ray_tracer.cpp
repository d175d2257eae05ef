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

// The bounce of the rays: after the camera's, which culls no back faces and ends nowhere.
constexpr uint32_t kBounce = 1;

TracedHit tracedHit(const Hit& hit) {
    const bool isMet = hit.t < std::numeric_limits<float>::infinity();
    return {hit.t, isMet ? SurfaceId{hit.record} : kNoSurface};
}

} // namespace

RayTracer::RayTracer(gpu::Device& device, const GpuScene& scene, bool countsVisits)
    : device_(&device), scene_(&scene),
      visits_(device, "visit counts", sizeof(VisitCounts), gpu::BufferUse::readback) {
    if (isOnHost(scene.accelerator().kind()))
        return;
    closest_ = makeKernel(device, "trace_closest", scene.accelerator().kind(), countsVisits);
    any_ = makeKernel(device, "trace_any", scene.accelerator().kind(), countsVisits);
}

template <typename Take>
void RayTracer::byHost(size_t count, const Take& take) {
    constexpr size_t kTogether = 4096;
    const auto start = std::chrono::steady_clock::now();
    const HostScene scene = hostScene(*scene_, 0); // all surfaces are opaque to these rays
    WaveRange range{};
    range.pixelCount = range.sampleCount = 1;
    forEachInParallel((count + kTogether - 1) / kTogether, [&](size_t part) {
        HostRays host(scene, {}, range);
        take(host, part * kTogether, std::min(count, (part + 1) * kTogether));
    });
    lastSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

size_t RayTracer::maxRays() const {
    return std::min<size_t>(size_t{device_->limits().maxGroups} * kWorkgroupSize,
                            device_->limits().maxStorageBufferBytes / sizeof(ShadowRay));
}

std::vector<TracedHit> RayTracer::closest(std::span<const Ray> rays, Likeness likeness) {
    if (!closest_) {
        std::vector<TracedHit> hits(rays.size());
        byHost(rays.size(), [&](HostRays& host, size_t first, size_t end) {
            const std::vector<uint32_t> slots(end - first);
            std::vector<Ray> some(rays.begin() + static_cast<std::ptrdiff_t>(first),
                                  rays.begin() + static_cast<std::ptrdiff_t>(end));
            std::vector<HostHit> met(end - first);
            host.trace(kBounce, likeness, slots, some, met);
            std::ranges::transform(met, hits.begin() + static_cast<std::ptrdiff_t>(first), tracedHit,
                                   &HostHit::hit);
        });
        return hits;
    }
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
    if (!any_) {
        std::vector<uint32_t> flags(rays.size());
        byHost(rays.size(), [&](HostRays& host, size_t first, size_t end) {
            const std::vector<uint32_t> slots(end - first);
            std::vector<uint8_t> occluded(end - first);
            host.findOccluded(0, slots, rays.subspan(first, end - first), occluded);
            std::ranges::copy(occluded, flags.begin() + static_cast<std::ptrdiff_t>(first));
        });
        return flags;
    }
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
