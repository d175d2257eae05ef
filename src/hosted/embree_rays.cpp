// Rays of shaders by Embree, with our own test of the triangles that it proposes.
#include <array>

#include "hosted/shader_rays.h"

namespace lavalight::glsl {
namespace {

// A ray on its way through Embree.
struct Lane {
    ShaderRays::RayFilter ignored;
    ShaderRays::ShearedRay ray;
    ShaderRays::NearestHit nearest; // so far
};

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

Query makeQuery(ShaderRays& shader, Lane* lanes, [[maybe_unused]] Likeness likeness) {
    Query query{{}, &shader, lanes};
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&query.context);
#else
    rtcInitIntersectContext(&query.context);
    query.context.filter = filter;
    if (likeness == Likeness::alike)
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

bool ShaderRays::closestByEmbree(vec3 origin, vec3 direction, float tMax, const RayFilter& ignored,
                                 Hit& hit) {
    if (!isTraceable(origin, direction))
        return false;
    Lane lane = makeLane(*this, origin, direction, tMax, ignored);
    Query query = makeQuery(*this, &lane, Likeness::unlike);
    RTCRayHit ray;
    ray.ray = toEmbree(origin, direction, withMargin(tMax));
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(embree, query, ray);
    hit = lane.nearest.hit;
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

bool ShaderRays::anyByEmbree(vec3 origin, vec3 direction, float tMax, const RayFilter& ignored) {
    if (!isTraceable(origin, direction))
        return false;
    Lane lane = makeLane(*this, origin, direction, tMax, ignored);
    Query query = makeQuery(*this, &lane, Likeness::unlike);
    RTCRay ray = toEmbree(origin, direction, withMargin(tMax));
    occlude(embree, query, ray);
    return ray.tfar < 0.0f; // Embree's mark of an occluded ray
}

void ShaderRays::traceByEmbree(uint32_t bounce, std::span<const uint32_t> slots, std::span<const Ray> rays,
                               std::span<Hit> hits) {
    constexpr size_t kRays = kMostByEmbree;
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
    Query query = makeQuery(*this, lanes.data(), Likeness::alike);
    intersect(embree, query, valid.data(), packet);
    for (size_t i = 0; i < rays.size(); ++i) {
        hits[i] = lanes[i].nearest.hit;
        if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID)
            hits[i].t = kInfinity;
    }
}

} // namespace lavalight::glsl
