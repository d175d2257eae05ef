#include "accel/embree_input.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "shared/bvh.h"

namespace lavalight {

Bounds boundsToBuildIn(std::span<const Triangle> triangles) {
    BuildBox box;
    for (size_t id = 0; id < triangles.size(); ++id) {
        for (const glm::vec3& v : {triangles[id].v0, triangles[id].v1, triangles[id].v2}) {
            const bool inRange = glm::all(glm::lessThanEqual(glm::abs(v), glm::vec3(kMaxCoordinate)));
            if (!inRange) // false for NaN
                throw Error(
                    fmt::format("cannot build the BVH: triangle {} has the vertex ({}, {}, {}); coordinates "
                                "must be finite and at most {}: scale the scene down or repair the mesh",
                                id, v.x, v.y, v.z, kMaxCoordinate));
        }
        box.extend(triangleBox(triangles[id]));
    }
    return triangles.empty() ? Bounds{} : Bounds{box.lower, box.upper};
}

BuildScale::BuildScale(const Bounds& bounds) {
    const glm::vec3 reach = glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper));
    const float largest = std::max({reach.x, reach.y, reach.z});
    scale_ = largest > 0.0f ? std::ldexp(1.0, -1 - std::ilogb(largest)) : 1.0;
}

RTCBuildPrimitive BuildScale::primitive(const BuildBox& box, uint32_t id) const {
    const glm::vec3 lower(scale_ * glm::dvec3(box.lower));
    const glm::vec3 upper(scale_ * glm::dvec3(box.upper));
    return {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, id};
}

BuildMemory makeBuildMemory(uint32_t threads) {
    const std::string configuration = fmt::format("threads={}", threads > 0 ? threads : threadLimit());
    EmbreeDevice device(rtcNewDevice(configuration.c_str()));
    EmbreeBvh bvh(device ? rtcNewBVH(device.get()) : nullptr);
    if (!bvh)
        throw Error("cannot build the BVH: Embree does not start (out of memory?)");
    return {std::move(device), std::move(bvh)};
}

} // namespace lavalight
