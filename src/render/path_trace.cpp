#include "render/path_trace.h"

#include <cassert>
#include <span>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/kernel.h"

namespace lavalight {

TracedPath tracePath(gpu::Device& device, const Renderer& renderer, const glm::uvec2& pixel, uint32_t sample,
                     const KernelSource& source) {
    const FrameParameters& frame = renderer.frame();
    assert(pixel.x < frame.imageWidth && pixel.y < frame.imageHeight);
    gpu::Buffer uniforms(device, "frame parameters", sizeof(FrameParameters), gpu::BufferUse::uniform);
    uniforms.upload(std::span(&frame, 1));
    const gpu::Buffer ray(device, "ray", sizeof(Ray), gpu::BufferUse::storage);
    const gpu::Buffer path(device, "path", sizeof(Path), gpu::BufferUse::storage);
    const gpu::Buffer traced(device, "traced vertex", sizeof(TracedVertex), gpu::BufferUse::storage);
    gpu::ResourceTable resources;
    renderer.scene().addTo(resources);
    resources.set("Frame", uniforms);
    resources.set("Rays", ray);
    resources.set("Paths", path);
    resources.set("TracedOut", traced);
    const gpu::Kernel kernel(device, source("trace_path"), renderer.kernels().constants());
    const gpu::BoundKernel bound(device, kernel, resources);
    gpu::Commands commands(device);

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
