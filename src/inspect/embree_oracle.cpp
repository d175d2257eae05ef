// Embree's own ray traversal.
#include "inspect/embree_oracle.h"

#include <numeric>

#include "base/error.h"
#include "base/log.h"

namespace lavalight {

namespace {

// Embree 3 takes a context with each ray; Embree 4 (Debian 13) takes none.
class Tracer {
  public:
#if RTC_VERSION_MAJOR >= 4
    void closest(RTCScene scene, RTCRayHit& query) {
        rtcIntersect1(scene, &query);
    }
    void occluded(RTCScene scene, RTCRay& query) {
        rtcOccluded1(scene, &query);
    }
#else
    Tracer() {
        rtcInitIntersectContext(&context_);
    }
    void closest(RTCScene scene, RTCRayHit& query) {
        rtcIntersect1(scene, &context_, &query);
    }
    void occluded(RTCScene scene, RTCRay& query) {
        rtcOccluded1(scene, &context_, &query);
    }

  private:
    RTCIntersectContext context_;
#endif
};

RTCRay toEmbree(const OracleRay& ray) {
    RTCRay result{};
    result.org_x = ray.origin.x;
    result.org_y = ray.origin.y;
    result.org_z = ray.origin.z;
    result.dir_x = ray.direction.x;
    result.dir_y = ray.direction.y;
    result.dir_z = ray.direction.z;
    result.tfar = ray.tMax;
    result.mask = ~0u;
    return result;
}

// A triangle list without shared vertices; the scene owns the copies.
void addTriangles(RTCDevice device, RTCScene scene, std::span<const Triangle> triangles) {
    static_assert(sizeof(Triangle) == 9 * sizeof(float));
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const size_t corners = 3 * triangles.size();
    auto* vertices = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Triangle) / 3, corners));
    auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), triangles.size()));
    if (vertices && indices) {
        std::copy(triangles.begin(), triangles.end(), vertices);
        std::iota(indices, indices + corners, 0u);
        rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
    }
    rtcReleaseGeometry(geometry); // the scene holds its own reference
}

} // namespace

EmbreeOracle::EmbreeOracle(std::span<const Triangle> triangles, Traversal traversal)
    : device_(rtcNewDevice(nullptr)), scene_(device_ ? rtcNewScene(device_.get()) : nullptr) {
    if (!scene_)
        throw Error("cannot trace rays with Embree: it does not start (out of memory?)");
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
    if (traversal == Traversal::robust)
        rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    if (!triangles.empty())
        addTriangles(device_.get(), scene_.get(), triangles);
    rtcCommitScene(scene_.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
        throw Error(
            fmt::format("cannot trace rays with Embree: building over {} triangles failed with its error {}",
                        triangles.size(), static_cast<int>(error)));
}

std::vector<OracleHit> EmbreeOracle::closest(std::span<const OracleRay> rays) const {
    std::vector<OracleHit> hits(rays.size());
    Tracer tracer;
    for (size_t i = 0; i < rays.size(); ++i) {
        RTCRayHit query{toEmbree(rays[i]), {}};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        tracer.closest(scene_.get(), query);
        if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID)
            hits[i] = {query.ray.tfar, query.hit.primID};
    }
    return hits;
}

std::vector<uint8_t> EmbreeOracle::occluded(std::span<const OracleRay> rays) const {
    std::vector<uint8_t> flags(rays.size());
    Tracer tracer;
    for (size_t i = 0; i < rays.size(); ++i) {
        RTCRay query = toEmbree(rays[i]);
        tracer.occluded(scene_.get(), query);
        flags[i] = query.tfar < 0.0f; // Embree's mark of an occluded ray
    }
    return flags;
}

} // namespace lavalight
