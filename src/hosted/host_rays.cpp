#include "hosted/host_rays.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtc/packing.hpp>
#include <glm/gtx/vec_swizzle.hpp>

#include "hosted/bvh16_rays.h"
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

    const Bvh16* bvh16 = nullptr; // null: Embree has the scene
    RTCScene embree = nullptr;

#include "shader_rays_members.h"

    // trace() of several rays, in a scene without solids.
    void traceTogether(uint32_t bounce, std::span<const uint32_t> slots, std::span<const Ray> rays,
                       std::span<Hit> hits);
};

namespace {

// A ray on its way through Embree.
struct Lane {
    ShaderRays::RayFilter ignored;
    ShaderRays::ShearedRay ray;
    ShaderRays::NearestHit nearest; // so far
};

// What our own tree asks.
struct OwnQuery {
    ShaderRays* shader;
    const ShaderRays::RayFilter* ignored;
};

bool takes(void* taker, const Bvh16Hit& hit) {
    const OwnQuery& query = *static_cast<const OwnQuery*>(taker);
    return query.shader->takesMet({hit.t, hit.barycentrics, hit.front},
                                  query.shader->loadTriangle(hit.triangle), *query.ignored);
}

std::optional<Bvh16Hit> findInOwnTree(ShaderRays& shader, vec3 origin, vec3 direction, float tMax,
                                      const ShaderRays::RayFilter& ignored, bool isAny) {
    direction = shader.withoutZeros(direction);
    const ShaderRays::ShearedRay sheared = shader.shearRay(origin, direction);
    OwnQuery query{&shader, &ignored};
    const Bvh16Ray ray{.origin = origin,
                       .direction = direction,
                       .shear = sheared.shear,
                       .mainAxis = sheared.xMain   ? 0
                                   : sheared.yMain ? 1
                                                   : 2,
                       .end = tMax,
                       .firstIgnored = ignored.firstSurface.primitive,
                       .secondIgnored = ignored.secondSurface.primitive,
                       .cullsBackFaces = ignored.cullBackFaces};
    return traverse(*shader.bvh16, ray, {takes, &query}, isAny);
}

// One ray or several, about which Embree asks for every triangle that it finds.
struct Query {
#if RTC_VERSION_MAJOR >= 4
    RTCRayQueryContext context;
#else
    RTCIntersectContext context;
#endif
    ShaderRays* shader;
    Lane* lanes; // by the rays' ids
};

void filter(const RTCFilterFunctionNArguments* asked) {
    Query& query = *reinterpret_cast<Query*>(asked->context);
    const unsigned rays = asked->N;
    for (unsigned i = 0; i < rays; ++i) {
        if (asked->valid[i] != -1)
            continue;
        Lane& lane = query.lanes[RTCRayN_id(asked->ray, rays, i)];
        const vec2 proposed(RTCHitN_u(asked->hit, rays, i), RTCHitN_v(asked->hit, rays, i));
        if (query.shader->takesProposed(lane.ray, RTCHitN_primID(asked->hit, rays, i), proposed, lane.ignored,
                                        lane.nearest))
            RTCRayN_tfar(asked->ray, rays, i) = query.shader->withMargin(lane.nearest.hit.t);
        else
            asked->valid[i] = 0;
    }
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

Lane makeLane(ShaderRays& shader, vec3 origin, vec3 direction, float tMax,
              const ShaderRays::RayFilter& ignored) {
    return {ignored, shader.shearRay(origin, shader.withoutZeros(direction)), shader.nothingBefore(tMax)};
}

enum class Likeness { none, coherent };

Query makeQuery(ShaderRays& shader, Lane* lanes, [[maybe_unused]] Likeness likeness) {
    Query query{{}, &shader, lanes};
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&query.context);
#else
    rtcInitIntersectContext(&query.context);
    query.context.filter = filter;
    if (likeness == Likeness::coherent)
        query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif
    return query;
}

#if RTC_VERSION_MAJOR >= 4
template <typename Arguments>
void setFilter(Arguments& arguments, Query& query, RTCRayQueryFlags flags = RTC_RAY_QUERY_FLAG_NONE) {
    arguments.context = &query.context;
    arguments.filter = filter;
    arguments.flags = static_cast<RTCRayQueryFlags>(RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER | flags);
}

void intersect(RTCScene scene, Query& query, RTCRayHit& ray) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    setFilter(arguments, query);
    rtcIntersect1(scene, &ray, &arguments);
}

void intersect(RTCScene scene, Query& query, const int* valid, RTCRayHit8& rays) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    setFilter(arguments, query, RTC_RAY_QUERY_FLAG_COHERENT);
    rtcIntersect8(valid, scene, &rays, &arguments);
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

void intersect(RTCScene scene, Query& query, const int* valid, RTCRayHit8& rays) {
    rtcIntersect8(valid, scene, &query.context, &rays);
}

void occlude(RTCScene scene, Query& query, RTCRay& ray) {
    rtcOccluded1(scene, &query.context, &ray);
}
#endif

} // namespace

bool ShaderRays::intersectClosest(vec3 origin, vec3 direction, float tMax, RayFilter ignored, Hit& hit) {
    hit = nothingBefore(tMax).hit;
    if (bvh16 != nullptr) {
        const std::optional<Bvh16Hit> met = findInOwnTree(*this, origin, direction, tMax, ignored, false);
        if (met)
            hit = {met->t, met->triangle, met->barycentrics};
        return met.has_value();
    }
    if (!isTraceable(origin, direction))
        return false;
    Lane lane = makeLane(*this, origin, direction, tMax, ignored);
    Query query = makeQuery(*this, &lane, Likeness::none);
    RTCRayHit ray;
    ray.ray = toEmbree(origin, direction, withMargin(tMax));
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(embree, query, ray);
    hit = lane.nearest.hit;
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

bool ShaderRays::intersectAny(vec3 origin, vec3 direction, float tMax, RayFilter ignored) {
    if (bvh16 != nullptr)
        return findInOwnTree(*this, origin, direction, tMax, ignored, true).has_value();
    if (!isTraceable(origin, direction))
        return false;
    Lane lane = makeLane(*this, origin, direction, tMax, ignored);
    Query query = makeQuery(*this, &lane, Likeness::none);
    RTCRay ray = toEmbree(origin, direction, withMargin(tMax));
    occlude(embree, query, ray);
    return ray.tfar < 0.0f; // Embree's mark of an occluded ray
}
#pragma GCC diagnostic pop

void ShaderRays::traceTogether(uint32_t bounce, std::span<const uint32_t> slots, std::span<const Ray> rays,
                               std::span<Hit> hits) {
    constexpr size_t kRays = HostRays::kRaysTogether;
    std::array<Lane, kRays> lanes;
    alignas(32) std::array<int, kRays> valid{};
    RTCRayHit8 packet;
    for (uint32_t i = 0; i < rays.size(); ++i) {
        const Ray& ray = rays[i];
        const float end = endOf(bounce, ray);
        lanes[i] = makeLane(*this, ray.origin, ray.direction, end, filterOf(slots[i], bounce, ray));
        valid[i] = isTraceable(ray.origin, ray.direction) ? -1 : 0;
        RTCRay8& to = packet.ray;
        to.org_x[i] = ray.origin.x;
        to.org_y[i] = ray.origin.y;
        to.org_z[i] = ray.origin.z;
        to.dir_x[i] = ray.direction.x;
        to.dir_y[i] = ray.direction.y;
        to.dir_z[i] = ray.direction.z;
        to.tnear[i] = to.time[i] = 0.0f;
        to.tfar[i] = withMargin(end);
        to.mask[i] = ~0u;
        to.id[i] = i;
        to.flags[i] = 0;
        packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    Query query = makeQuery(*this, lanes.data(), Likeness::coherent);
    intersect(embree, query, valid.data(), packet);
    for (size_t i = 0; i < rays.size(); ++i) {
        hits[i] = lanes[i].nearest.hit;
        if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID)
            hits[i].t = kInfinity;
    }
}

} // namespace glsl

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

Hit HostRays::trace(uint32_t slot, uint32_t bounce, Ray& ray) {
    return members_->shader.trace(slot, bounce, ray);
}

void HostRays::trace(uint32_t bounce, std::span<const uint32_t> slots, std::span<Ray> rays,
                     std::span<Hit> hits) {
    glsl::ShaderRays& shader = members_->shader;
    assert(rays.size() <= kRaysTogether && slots.size() == rays.size() && hits.size() == rays.size());
    if (shader.bvh16 == nullptr && !shader.has(kFeatureSolids)) {
        shader.traceTogether(bounce, slots, rays, hits);
        return;
    }
    for (size_t i = 0; i < rays.size(); ++i)
        hits[i] = shader.trace(slots[i], bounce, rays[i]);
}

bool HostRays::isOccluded(const ShadowRay& ray, uint32_t slot, uint32_t bounce) {
    return members_->shader.isOccluded(ray, slot, bounce);
}

uint32_t HostRays::materialOf(const Hit& hit) const {
    return members_->shader.loadTriangle(hit.record).material & kMaterialMask;
}

} // namespace lavalight
