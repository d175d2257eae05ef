// Rays of shaders by the host's own tree.
#include <memory>

#include "hosted/shader_rays.h"

namespace lavalight::glsl {
namespace {

// What our own tree asks: filterOf(ray) is the filter of a ray.
template <typename FilterOf>
struct OwnQuery {
    ShaderRays* shader;
    const FilterOf* filterOf;

    static bool takes(void* taker, size_t ray, const Bvh16Hit& hit) {
        const OwnQuery& query = *static_cast<const OwnQuery*>(taker);
        return query.shader->takesMet({hit.t, hit.barycentrics, hit.front},
                                      query.shader->loadTriangle(hit.triangle), (*query.filterOf)(ray));
    }
};

template <typename FilterOf>
void findInOwnTree(ShaderRays& shader, std::span<const Bvh16Ray> rays, Sought sought, Likeness likeness,
                   const FilterOf& filterOf, std::span<Bvh16Hit> hits) {
    OwnQuery<FilterOf> query{&shader, &filterOf};
    traverse({*shader.bvh16, rays, sought, likeness, {query.takes, &query}, hits});
}

// Sets a ray in place. Copying one that has just been put together stalls the processor, which cannot load as
// a whole what it stored in parts.
void set(Bvh16Ray& ray, const vec3& origin, const vec3& direction, float end, SurfaceId firstIgnored,
         SurfaceId secondIgnored, bool cullsBackFaces) {
    ray.origin = origin;
    ray.direction = direction;
    ray.end = end;
    ray.firstIgnored = firstIgnored.primitive;
    ray.secondIgnored = secondIgnored.primitive;
    ray.cullsBackFaces = cullsBackFaces;
}

Bvh16Hit findOneInOwnTree(ShaderRays& shader, const vec3& origin, const vec3& direction, float end,
                          const ShaderRays::RayFilter& ignored, Sought sought) {
    Bvh16Ray ray;
    set(ray, origin, direction, end, ignored.firstSurface, ignored.secondSurface, ignored.cullBackFaces);
    Bvh16Hit hit;
    findInOwnTree(
        shader, std::span(&ray, 1), sought, Likeness::unlike, [&](size_t) { return ignored; },
        std::span(&hit, 1));
    return hit;
}

// Room for many rays, which is not set to zero first.
template <typename Element>
class Room {
  public:
    explicit Room(size_t count)
        : count_(count), elements_(std::make_unique_for_overwrite<Element[]>(count)) {}
    [[nodiscard]] std::span<Element> all() const { return {elements_.get(), count_}; }

  private:
    size_t count_;
    std::unique_ptr<Element[]> elements_;
};

bool isFound(const Bvh16Hit& hit) {
    return hit.triangle != kNoTriangle;
}

} // namespace

bool ShaderRays::closestInOwnTree(vec3 origin, vec3 direction, float tMax, const RayFilter& ignored,
                                  Hit& hit) {
    const Bvh16Hit met = findOneInOwnTree(*this, origin, direction, tMax, ignored, Sought::first);
    if (isFound(met))
        hit = {met.t, met.triangle, met.barycentrics};
    return isFound(met);
}

bool ShaderRays::anyInOwnTree(vec3 origin, vec3 direction, float tMax, const RayFilter& ignored) {
    return isFound(findOneInOwnTree(*this, origin, direction, tMax, ignored, Sought::any));
}

void ShaderRays::traceInOwnTree(uint32_t bounce, Likeness likeness, std::span<const uint32_t> slots,
                                std::span<const Ray> rays, std::span<HostHit> hits) {
    const Room<Bvh16Ray> own(rays.size());
    const Room<Bvh16Hit> room(rays.size());
    const std::span met = room.all();
    for (size_t i = 0; i < rays.size(); ++i)
        set(own.all()[i], rays[i].origin, rays[i].direction, endOf(bounce, rays[i]), rays[i].fromSurface,
            kNoSurface, cullsBackFaces(bounce));
    findInOwnTree(
        *this, own.all(), Sought::first, likeness,
        [&](size_t i) { return filterOf(slots[i], bounce, rays[i]); }, met);
    for (size_t i = 0; i < rays.size(); ++i) {
        hits[i].hit.t = isFound(met[i]) ? met[i].t : kInfinity;
        hits[i].hit.record = met[i].triangle;
        hits[i].hit.barycentrics = met[i].barycentrics;
        hits[i].material = met[i].material & kMaterialMask;
    }
}

void ShaderRays::findOccludedInOwnTree(uint32_t bounce, std::span<const uint32_t> slots,
                                       std::span<const ShadowRay> rays, std::span<uint8_t> occluded) {
    const Room<Bvh16Ray> own(rays.size());
    const Room<Bvh16Hit> room(rays.size());
    const std::span met = room.all();
    for (size_t i = 0; i < rays.size(); ++i)
        set(own.all()[i], rays[i].origin, rays[i].direction, 1.0f, rays[i].fromSurface, rays[i].toSurface,
            false);
    findInOwnTree(
        *this, own.all(), Sought::any, Likeness::unlike,
        [&](size_t i) { return shadowFilterOf(slots[i], bounce, rays[i]); }, met);
    for (size_t i = 0; i < rays.size(); ++i)
        occluded[i] = isFound(met[i]) ? 1 : 0;
}

} // namespace lavalight::glsl
