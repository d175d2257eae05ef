#include "inspect/ray_tracer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>

#include "device_scene/scene_features.h"
#include "gpu/buffer.h"
#include "kernels/kernel_source.h"
#include "shared/frame.h"

namespace lavalight {
namespace {

gpu::Kernel makeKernel(const gpu::Device& device, std::string_view name, bool countsVisits) {
    // No features: all surfaces are opaque to these rays.
    const auto [first, second] = featureConstants(0);
    const std::array<gpu::SpecialisationConstant, 3> constants{
        {{CONSTANT_COUNT_VISITS, countsVisits ? 1u : 0u}, first, second}};
    return {device, embeddedKernel(name), constants};
}

} // namespace

RayTracer::RayTracer(gpu::Device& device, const GpuScene& scene, bool countsVisits)
    : device_(&device), scene_(&scene), closest_(makeKernel(device, "trace_closest", countsVisits)),
      any_(makeKernel(device, "trace_any", countsVisits)),
      visits_(device, "visit counts", sizeof(VisitCounts), gpu::BufferUse::readback) {}

size_t RayTracer::maxRays() const {
    return std::min<size_t>(size_t{device_->limits().maxGroups} * kWorkgroupSize,
                            device_->limits().maxStorageBufferBytes / sizeof(ShadowRay));
}

std::vector<TracedHit> RayTracer::closest(std::span<const Ray> rays) {
    gpu::Buffer in(*device_, "rays", rays.size_bytes(), gpu::BufferUse::storage);
    const gpu::Buffer out(*device_, "hits", rays.size() * sizeof(TracedHit), gpu::BufferUse::storage);
    in.upload(rays);
    gpu::ResourceTable resources;
    scene_->addTo(resources);
    resources.set("Rays", in);
    resources.set("TracedHits", out);
    run(closest_, resources, rays.size());
    return out.downloadAll<TracedHit>();
}

std::vector<uint32_t> RayTracer::occluded(std::span<const ShadowRay> rays) {
    gpu::Buffer in(*device_, "shadow rays", rays.size_bytes(), gpu::BufferUse::storage);
    const gpu::Buffer out(*device_, "shadow flags", rays.size() * sizeof(uint32_t), gpu::BufferUse::storage);
    in.upload(rays);
    gpu::ResourceTable resources;
    scene_->addTo(resources);
    resources.set("ShadowRays", in);
    resources.set("Occluded", out);
    run(any_, resources, rays.size());
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
