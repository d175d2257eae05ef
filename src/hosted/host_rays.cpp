#include "hosted/host_rays.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <span>

#include "hosted/shader_rays.h"

namespace lavalight {

bool glsl::ShaderRays::intersectClosest(vec3 origin, vec3 direction, float tMax, RayFilter ignored,
                                        Hit& hit) {
    hit = nothingBefore(tMax).hit;
    return bvh16 != nullptr ? closestInOwnTree(origin, direction, tMax, ignored, hit)
                            : closestByEmbree(origin, direction, tMax, ignored, hit);
}

bool glsl::ShaderRays::intersectAny(vec3 origin, vec3 direction, float tMax, RayFilter ignored) {
    return bvh16 != nullptr ? anyInOwnTree(origin, direction, tMax, ignored)
                            : anyByEmbree(origin, direction, tMax, ignored);
}

HostScene hostScene(const GpuScene& scene, SceneFeatures features) {
    const Accelerator& accelerator = scene.accelerator();
    assert(isOnHost(accelerator.kind()));
    gpu::ResourceTable buffers;
    scene.addTo(buffers);
    const auto texels = [&](const char* name) {
        const std::span<const glm::uvec4> mapped = buffers.get(name).mapped<const glm::uvec4>();
        assert(mapped.data() != nullptr);
        return mapped;
    };
    return {texels("triangles"),      texels("triangleNormals"),
            texels("materials"),      texels("pictures"),
            texels("textures"),       texels("triangleUvs"),
            texels("triangleColors"), accelerator.bvh16(),
            accelerator.embree(),     features};
}

bool tracesAsHost(const KernelSource& source) {
    return std::ranges::all_of(kTracingKernels, [&](std::string_view kernel) {
        return source(kernel).content == embeddedKernel(kernel).content;
    });
}

struct HostRays::Members {
    glsl::ShaderRays shader;
};

HostRays::HostRays(const HostScene& scene, const FrameParameters& frame, const WaveRange& range)
    : members_(std::make_unique<Members>()) {
    glsl::ShaderRays& shader = members_->shader;
    shader.features = scene.features;
    shader.bvh16 = scene.bvh16;
    shader.embree = scene.embree != nullptr ? scene.embree->scene() : nullptr;
    shader.frame = frame;
    shader.range = range;
    shader.triangles = {scene.triangles.data()};
    shader.triangleNormals = {scene.triangleNormals.data()};
    shader.materials = {scene.materials.data()};
    shader.pictures = {scene.pictures.data()};
    shader.textures = {scene.textures.data()};
    shader.triangleUvs = {scene.triangleUvs.data()};
    shader.triangleColors = {scene.triangleColors.data()};
}

HostRays::~HostRays() = default;

void HostRays::trace(uint32_t bounce, Likeness likeness, std::span<const uint32_t> slots, std::span<Ray> rays,
                     std::span<HostHit> hits) {
    assert(slots.size() == rays.size() && hits.size() == rays.size());
    glsl::ShaderRays& shader = members_->shader;
    const bool hasSolids = shader.has(kFeatureSolids);
    if (shader.bvh16 != nullptr && !hasSolids) {
        shader.traceInOwnTree(bounce, likeness, slots, rays, hits);
        return;
    }
    // Embree traces rays that are unlike faster one by one. Rays among solids change on their way.
    const size_t together = likeness == Likeness::alike && !hasSolids ? glsl::ShaderRays::kMostByEmbree : 1;
    for (size_t first = 0; first < rays.size(); first += together) {
        const size_t count = std::min(rays.size() - first, together);
        std::array<Hit, glsl::ShaderRays::kMostByEmbree> met;
        if (together > 1)
            shader.traceByEmbree(bounce, slots.subspan(first, count), rays.subspan(first, count),
                                 std::span(met).first(count));
        else
            met[0] = shader.trace(slots[first], bounce, rays[first]);
        for (size_t i = 0; i < count; ++i) {
            const bool isMet = met[i].t < std::numeric_limits<float>::infinity();
            hits[first + i] = {met[i],
                               isMet ? shader.loadTriangle(met[i].record).material & kMaterialMask : 0};
        }
    }
}

void HostRays::findOccluded(uint32_t bounce, std::span<const uint32_t> slots, std::span<const ShadowRay> rays,
                            std::span<uint8_t> occluded) {
    assert(slots.size() == rays.size() && occluded.size() == rays.size());
    glsl::ShaderRays& shader = members_->shader;
    if (shader.bvh16 != nullptr)
        shader.findOccludedInOwnTree(bounce, slots, rays, occluded);
    else
        for (size_t i = 0; i < rays.size(); ++i)
            occluded[i] = shader.isOccluded(rays[i], slots[i], bounce) ? 1 : 0;
}

} // namespace lavalight
