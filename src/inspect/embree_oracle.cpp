// Embree's own ray traversal.
#include "inspect/embree_oracle.h"

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

} // namespace

EmbreeOracle::EmbreeOracle(std::span<const Triangle> triangles, Traversal traversal)
    : triangles_(triangles, RTC_BUILD_QUALITY_HIGH,
                 traversal == Traversal::robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE) {}

std::vector<OracleHit> EmbreeOracle::closest(std::span<const OracleRay> rays) const {
    std::vector<OracleHit> hits(rays.size());
    Tracer tracer;
    for (size_t i = 0; i < rays.size(); ++i) {
        RTCRayHit query{toEmbree(rays[i]), {}};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        tracer.closest(triangles_.scene(), query);
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
        tracer.occluded(triangles_.scene(), query);
        flags[i] = query.tfar < 0.0f; // Embree's mark of an occluded ray
    }
    return flags;
}

} // namespace lavalight
