#include "inspect/path_inspector.h"

#include <algorithm>
#include <cassert>
#include <span>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "hosted/host_rays.h"
#include "shared/path_layers.h"

namespace lavalight {
namespace {

// The kernel that follows a path with the accelerator.
std::string kernelFor(AcceleratorKind accelerator) {
    return isOnHost(accelerator) ? "hosted/trace_path"
                                 : textOf({"trace_path", kernelAccelerator(accelerator)});
}

} // namespace

// The path under way, on the device.
class PathInspector::State {
  public:
    State(gpu::Device& device, const gpu::Kernel& kernel, const Renderer& renderer)
        : frame_(device, "frame parameters", sizeof(FrameParameters), gpu::BufferUse::uniform),
          ray_(device, "ray", sizeof(Ray), gpu::BufferUse::storage),
          path_(device, "path", sizeof(Path), gpu::BufferUse::storage),
          hit_(device, "hit", sizeof(Hit), gpu::BufferUse::storage),
          shadowRay_(device, "shadow ray", sizeof(ShadowRay), gpu::BufferUse::storage),
          vertex_(device, "traced vertex", sizeof(TracedVertex), gpu::BufferUse::storage),
          layers_(device, "path layers", sizeof(PathLayers), gpu::BufferUse::storage),
          bound_(device, kernel, resources(renderer)), commands_(device) {
        frame_.upload(std::span(&renderer.frame(), 1));
    }

    void run(const WaveRange& range) {
        commands_.begin();
        commands_.dispatch(bound_, 1, pushed(range));
        commands_.submitAndWait();
    }
    [[nodiscard]] Ray ray() const { return ray_.downloadAll<Ray>().front(); }
    [[nodiscard]] Path path() const { return path_.downloadAll<Path>().front(); }
    [[nodiscard]] ShadowRay shadowRay() const { return shadowRay_.downloadAll<ShadowRay>().front(); }
    [[nodiscard]] TracedVertex vertex() const { return vertex_.downloadAll<TracedVertex>().front(); }
    void set(const Ray& ray) { ray_.upload(std::span(&ray, 1)); }
    void set(const Path& path) { path_.upload(std::span(&path, 1)); }
    void set(const Hit& hit) { hit_.upload(std::span(&hit, 1)); }

  private:
    [[nodiscard]] gpu::ResourceTable resources(const Renderer& renderer) const {
        gpu::ResourceTable resources;
        renderer.scene().addTo(resources);
        resources.set("Frame", frame_);
        resources.set("Rays", ray_);
        resources.set("Paths", path_);
        resources.set("Hits", hit_);
        resources.set("ShadowRays", shadowRay_);
        resources.set("TracedOut", vertex_);
        resources.set("Layers", layers_); // written, where the render records them, and not read
        return resources;
    }

    gpu::Buffer frame_, ray_, path_, hit_, shadowRay_, vertex_, layers_;
    gpu::BoundKernel bound_;
    gpu::Commands commands_;
};

PathInspector::PathInspector(gpu::Device& device, const Renderer& renderer, const KernelSource& source)
    : device_(&device),
      constants_(renderer.kernels().constants().begin(), renderer.kernels().constants().end()),
      accelerator_(renderer.scene().accelerator().kind()),
      kernel_(device, source(kernelFor(accelerator_)), constants_) {}

bool PathInspector::serves(const Renderer& renderer) const {
    return std::ranges::equal(constants_, renderer.kernels().constants()) &&
           accelerator_ == renderer.scene().accelerator().kind();
}

// The vertex where the path's ray meets the scene.
TracedVertex PathInspector::traceByHost(const Renderer& renderer, State& state, WaveRange range) const {
    HostRays rays(hostScene(renderer.scene(), renderer.features()), renderer.frame(), range);
    if (range.bounce == 0)
        state.run(range);
    constexpr uint32_t kSlot = 0;
    Ray ray = state.ray();
    HostHit met{};
    rays.trace(range.bounce, Likeness::unlike, std::span(&kSlot, 1), std::span(&ray, 1), std::span(&met, 1));
    state.set(met.hit);
    state.set(ray);
    range.recordCount = 1;
    state.run(range);
    TracedVertex vertex = state.vertex();
    if ((vertex.flags & kTracedShadowRay) == 0)
        return vertex;
    const ShadowRay shadowRay = state.shadowRay();
    uint8_t isOccluded = 0;
    rays.findOccluded(range.bounce, std::span(&kSlot, 1), std::span(&shadowRay, 1),
                      std::span(&isOccluded, 1));
    if (isOccluded != 0) {
        vertex.flags |= kTracedOccluded;
    } else {
        Path path = state.path();
        path.radiance += vertex.direct;
        state.set(path);
    }
    return vertex;
}

TracedPath PathInspector::trace(const Renderer& renderer, const glm::uvec2& pixel, uint32_t sample) const {
    assert(serves(renderer));
    const FrameParameters& frame = renderer.frame();
    assert(pixel.x < frame.imageWidth && pixel.y < frame.imageHeight);
    State state(*device_, kernel_, renderer);
    TracedPath result;
    WaveRange range{};
    range.firstPixel = pixel.y * frame.imageWidth + pixel.x;
    range.pixelCount = range.sampleCount = 1;
    range.firstSample = sample;
    do {
        if (isOnHost(accelerator_)) {
            result.vertices.push_back(traceByHost(renderer, state, range));
        } else {
            state.run(range);
            result.vertices.push_back(state.vertex());
        }
        ++range.bounce;
    } while ((result.vertices.back().flags & kTracedGoesOn) != 0);
    result.radiance = state.path().radiance;
    return result;
}

} // namespace lavalight
