#include "accel/embree_triangles.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <numeric>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"

namespace lavalight {
namespace {

// A triangle list without shared vertices; the scene owns the copies.
void addTriangles(RTCDevice device, RTCScene scene, std::span<const Triangle> triangles,
                  RTCBuildQuality quality) {
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
        rtcSetGeometryBuildQuality(geometry, quality);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
    }
    rtcReleaseGeometry(geometry); // the scene holds its own reference
}

// A device that counts its memory.
EmbreeDevice newDevice(std::atomic<int64_t>& bytes) {
    EmbreeDevice device(rtcNewDevice(fmt::format("threads={}", threadLimit()).c_str()));
    const auto count = [](void* counter, ssize_t more, bool) {
        *static_cast<std::atomic<int64_t>*>(counter) += more;
        return true;
    };
    if (device)
        rtcSetDeviceMemoryMonitorFunction(device.get(), count, &bytes);
    return device;
}

} // namespace

EmbreeTriangles::EmbreeTriangles(std::span<const Triangle> triangles, RTCBuildQuality quality,
                                 RTCSceneFlags flags)
    : bytes_(std::make_unique<std::atomic<int64_t>>(0)), device_(newDevice(*bytes_)),
      scene_(device_ ? rtcNewScene(device_.get()) : nullptr) {
    const auto start = std::chrono::steady_clock::now();
    if (!scene_)
        throw Error("cannot start Embree (out of memory?)");
    rtcSetSceneBuildQuality(scene_.get(), quality);
    rtcSetSceneFlags(scene_.get(), flags);
    if (!triangles.empty())
        addTriangles(device_.get(), scene_.get(), triangles, quality);
    rtcCommitScene(scene_.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
        throw Error(fmt::format("cannot build Embree's tree over {} triangles: its error {}{}",
                                triangles.size(), static_cast<int>(error),
                                error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory" : ""));
    buildSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string EmbreeTriangles::identity() {
    const EmbreeDevice device(rtcNewDevice(nullptr));
    const auto property = [&](RTCDeviceProperty wanted) {
        return device ? static_cast<long>(rtcGetDeviceProperty(device.get(), wanted)) : 0;
    };
    const long version = property(RTC_DEVICE_PROPERTY_VERSION); // 31305: 3.13.5
    const char* set = "sse";
    if (property(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0)
        set = __builtin_cpu_supports("avx2") != 0 ? "avx2" : "avx";
    if (property(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0)
        set = "avx512";
    return fmt::format("embree {}.{}.{} {}", version / 10000, version / 100 % 100, version % 100, set);
}

} // namespace lavalight
