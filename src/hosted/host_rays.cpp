#include "hosted/host_rays.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtc/packing.hpp>
#include <glm/gtx/vec_swizzle.hpp>

#include "shared/scene.h"
#include "shared/texture.h"
#include "shared/trace.h"

namespace lavalight {
namespace glsl {

using namespace glm;

struct TexelBuffer {
    const uvec4* texels = nullptr;
};

inline uvec4 texelFetch(TexelBuffer buffer, int index) {
    return buffer.texels[index];
}

// The shaders' functions, constants and buffers as members. GLSL is written to other rules than those that
// C++ compilers warn about.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wparentheses"
#pragma GCC diagnostic ignored "-Wshadow"
#ifndef __clang__ // clang does not have this one
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
struct ShaderRays {
    SceneFeatures features = 0;
    [[nodiscard]] bool has(SceneFeatures feature) const { return (features & feature) != 0; }

    RTCScene embree = nullptr;

#include "shader_rays_members.h"
};

namespace {

// A ray on its way through Embree, which asks about every triangle that it finds.
struct Query {
#if RTC_VERSION_MAJOR >= 4
    RTCRayQueryContext context;
#else
    RTCIntersectContext context;
#endif
    ShaderRays* shader;
    const ShaderRays::RayFilter* ignored;
    ShaderRays::ShearedRay ray;
    ShaderRays::NearestHit nearest; // so far
};

void filter(const RTCFilterFunctionNArguments* asked) {
    if (asked->valid[0] != -1)
        return;
    Query& query = *reinterpret_cast<Query*>(asked->context);
    const vec2 proposed(RTCHitN_u(asked->hit, 1, 0), RTCHitN_v(asked->hit, 1, 0));
    if (query.shader->takesProposed(query.ray, RTCHitN_primID(asked->hit, 1, 0), proposed, *query.ignored,
                                    query.nearest))
        RTCRayN_tfar(asked->ray, 1, 0) = query.shader->withMargin(query.nearest.hit.t);
    else
        asked->valid[0] = 0;
}

RTCRay toEmbree(vec3 origin, vec3 direction, float end) {
    RTCRay ray;
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = 0.0f;
    ray.tfar = end;
    ray.time = 0.0f;
    ray.mask = ~0u;
    ray.id = 0;
    ray.flags = 0;
    return ray;
}

// What Embree takes: it ends the program for a ray that is not finite or starts beyond 1.8e18, which a camera
// at the end of the world may ask for. Such a ray meets nothing.
bool isTraceable(vec3 origin, vec3 direction) {
    constexpr float kFarthest = 1e18f;
    const auto isWithin = [](const vec3& v) {
        return std::abs(v.x) <= kFarthest && std::abs(v.y) <= kFarthest && std::abs(v.z) <= kFarthest;
    };
    return isWithin(origin) && isWithin(direction);
}

Query makeQuery(ShaderRays& shader, vec3 origin, vec3 direction, float tMax,
                const ShaderRays::RayFilter& ignored) {
    Query query{{}, &shader, &ignored, shader.shearRay(origin, direction), shader.nothingBefore(tMax)};
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&query.context);
#else
    rtcInitIntersectContext(&query.context);
    query.context.filter = filter;
#endif
    return query;
}

#if RTC_VERSION_MAJOR >= 4
template <typename Arguments>
void setFilter(Arguments& arguments, Query& query) {
    arguments.context = &query.context;
    arguments.filter = filter;
    arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
}

void intersect(RTCScene scene, Query& query, RTCRayHit& ray) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    setFilter(arguments, query);
    rtcIntersect1(scene, &ray, &arguments);
}

void occlude(RTCScene scene, Query& query, RTCRay& ray) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    setFilter(arguments, query);
    rtcOccluded1(scene, &ray, &arguments);
}
#else
void intersect(RTCScene scene, Query& query, RTCRayHit& ray) {
    rtcIntersect1(scene, &query.context, &ray);
}

void occlude(RTCScene scene, Query& query, RTCRay& ray) {
    rtcOccluded1(scene, &query.context, &ray);
}
#endif

} // namespace

bool ShaderRays::intersectClosest(vec3 origin, vec3 direction, float tMax, RayFilter ignored, Hit& hit) {
    Query query = makeQuery(*this, origin, direction, tMax, ignored);
    if (!isTraceable(origin, direction)) {
        hit = query.nearest.hit;
        return false;
    }
    RTCRayHit ray;
    ray.ray = toEmbree(origin, direction, withMargin(tMax));
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(embree, query, ray);
    hit = query.nearest.hit;
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

bool ShaderRays::intersectAny(vec3 origin, vec3 direction, float tMax, RayFilter ignored) {
    if (!isTraceable(origin, direction))
        return false;
    Query query = makeQuery(*this, origin, direction, tMax, ignored);
    RTCRay ray = toEmbree(origin, direction, withMargin(tMax));
    occlude(embree, query, ray);
    return ray.tfar < 0.0f; // Embree's mark of an occluded ray
}
#pragma GCC diagnostic pop

} // namespace glsl

HostScene hostScene(const GpuScene& scene, SceneFeatures features) {
    assert(scene.accelerator().embree() != nullptr);
    gpu::ResourceTable buffers;
    scene.addTo(buffers);
    const auto texels = [&](const char* name) {
        const std::span<const glm::uvec4> mapped = buffers.get(name).mapped<const glm::uvec4>();
        assert(mapped.data() != nullptr);
        return mapped;
    };
    return {texels("triangles"),      texels("triangleNormals"),    texels("materials"),
            texels("pictures"),       texels("textures"),           texels("triangleUvs"),
            texels("triangleColors"), scene.accelerator().embree(), features};
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
    shader.embree = scene.tree->scene();
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

Hit HostRays::trace(uint32_t slot, uint32_t bounce, Ray& ray) {
    return members_->shader.trace(slot, bounce, ray);
}

bool HostRays::isOccluded(const ShadowRay& ray, uint32_t slot, uint32_t bounce) {
    return members_->shader.isOccluded(ray, slot, bounce);
}

uint32_t HostRays::materialOf(const Hit& hit) const {
    return members_->shader.loadTriangle(hit.record).material & kMaterialMask;
}

} // namespace lavalight
