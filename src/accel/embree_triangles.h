// Triangles in a tree of Embree's own.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "accel/embree_handles.h"
#include "accel/triangle.h"

namespace lavalight {

// Flags of a scene whose rays the host traces for paths (src/hosted): watertight, with a filter for each
// query.
#if RTC_VERSION_MAJOR >= 4
inline const RTCSceneFlags kTracedByHost =
    RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#else
inline const RTCSceneFlags kTracedByHost = RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#endif

class EmbreeTriangles {
  public:
    // Embree's primitive i is triangles[i]; the corners are copied. Throws Error where Embree fails.
    EmbreeTriangles(std::span<const Triangle> triangles, RTCBuildQuality quality,
                    RTCSceneFlags flags = RTC_SCENE_FLAG_NONE);

    [[nodiscard]] RTCScene scene() const { return scene_.get(); }
    [[nodiscard]] double buildSeconds() const { return buildSeconds_; }
    // Memory of the tree and of the copied corners.
    [[nodiscard]] uint64_t bytes() const { return static_cast<uint64_t>(*bytes_); }

    // Embree's version and the instruction set that it takes on this processor, by which its answers may
    // differ: "embree 3.13.5 avx2".
    [[nodiscard]] static std::string identity();

  private:
    std::unique_ptr<std::atomic<int64_t>> bytes_; // at an address that Embree knows
    EmbreeDevice device_;
    EmbreeScene scene_;
    double buildSeconds_ = 0.0;
};

} // namespace lavalight
