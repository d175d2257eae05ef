#include "inspect/path_inspector.h"

#include <algorithm>
#include <cassert>
#include <span>

#include "gpu/buffer.h"
#include "gpu/commands.h"

namespace lavalight {

PathInspector::PathInspector(gpu::Device& device, const Renderer& renderer, const KernelSource& source)
    : device_(&device),
      constants_(renderer.kernels().constants().begin(), renderer.kernels().constants().end()),
      kernel_(device, source("trace_path"), constants_) {}

bool PathInspector::serves(const Renderer& renderer) const {
    return std::ranges::equal(constants_, renderer.kernels().constants());
}

TracedPath PathInspector::trace(const Renderer& renderer, const glm::uvec2& pixel, uint32_t sample) const {
    assert(serves(renderer));
    const FrameParameters& frame = renderer.frame();
    assert(pixel.x < frame.imageWidth && pixel.y < frame.imageHeight);
    gpu::Buffer uniforms(*device_, "frame parameters", sizeof(FrameParameters), gpu::BufferUse::uniform);
    uniforms.upload(std::span(&frame, 1));
    const gpu::Buffer ray(*device_, "ray", sizeof(Ray), gpu::BufferUse::storage);
    const gpu::Buffer path(*device_, "path", sizeof(Path), gpu::BufferUse::storage);
    const gpu::Buffer traced(*device_, "traced vertex", sizeof(TracedVertex), gpu::BufferUse::storage);
    gpu::ResourceTable resources;
    renderer.scene().addTo(resources);
    resources.set("Frame", uniforms);
    resources.set("Rays", ray);
    resources.set("Paths", path);
    resources.set("TracedOut", traced);
    const gpu::BoundKernel bound(*device_, kernel_, resources);
    gpu::Commands commands(*device_);

    TracedPath result;
    WaveRange range{};
    range.firstPixel = pixel.y * frame.imageWidth + pixel.x;
    range.pixelCount = range.sampleCount = 1;
    range.firstSample = sample;
    do {
        commands.begin();
        commands.dispatch(bound, 1, pushed(range));
        commands.submitAndWait();
        result.vertices.push_back(traced.downloadAll<TracedVertex>().front());
        ++range.bounce;
    } while ((result.vertices.back().flags & kTracedGoesOn) != 0);
    result.radiance = path.downloadAll<Path>().front().radiance;
    return result;
}

} // namespace lavalight
