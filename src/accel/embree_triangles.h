// Triangles in a tree of Embree's own.
#pragma once

#include <span>

#include "accel/embree_handles.h"
#include "accel/triangle.h"

namespace lavalight {

class EmbreeTriangles {
  public:
    // Embree's primitive i is triangles[i]; the corners are copied. Throws Error where Embree fails.
    EmbreeTriangles(std::span<const Triangle> triangles, RTCBuildQuality quality,
                    RTCSceneFlags flags = RTC_SCENE_FLAG_NONE);

    [[nodiscard]] RTCScene scene() const { return scene_.get(); }

  private:
    EmbreeDevice device_;
    EmbreeScene scene_;
};

} // namespace lavalight
