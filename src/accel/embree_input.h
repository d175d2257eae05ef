// Triangles as Embree's builder takes them.
#pragma once

#include <cstdint>
#include <span>

#include "accel/build_tree.h"
#include "accel/embree_handles.h"

namespace lavalight {

// The box around the triangles; both corners are 0 without any. Throws Error for a coordinate that is not
// finite or beyond kMaxCoordinate.
[[nodiscard]] Bounds boundsToBuildIn(std::span<const Triangle> triangles);

// Scales a scene by a power of two to coordinates below 1, which keeps Embree's areas and costs finite and
// normal.
class BuildScale {
  public:
    explicit BuildScale(const Bounds& bounds);
    [[nodiscard]] RTCBuildPrimitive primitive(const BuildBox& box, uint32_t id) const;

  private:
    double scale_;
};

// What Embree's builder makes lives in `bvh`.
struct BuildMemory {
    EmbreeDevice device;
    EmbreeBvh bvh;
};

// `threads`: how many build at once; 0: threadLimit(). Throws Error where Embree does not start.
[[nodiscard]] BuildMemory makeBuildMemory(uint32_t threads = 0);

} // namespace lavalight
