#include "accel/embree_triangles.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <numeric>

#include <fmt/format.h>

#include "base/error.h"

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

} // namespace

EmbreeTriangles::EmbreeTriangles(std::span<const Triangle> triangles, RTCBuildQuality quality,
                                 RTCSceneFlags flags)
    : device_(rtcNewDevice(nullptr)), scene_(device_ ? rtcNewScene(device_.get()) : nullptr) {
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
    const auto is = [&](RTCDeviceProperty property) {
        return device && rtcGetDeviceProperty(device.get(), property) != 0;
    };
    const char* const set = is(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)   ? "avx512"
                            : !is(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) ? "sse"
                            : __builtin_cpu_supports("avx2") != 0            ? "avx2"
                                                                             : "avx";
    return fmt::format("embree {} {}", RTC_VERSION_STRING, set);
}

} // namespace lavalight
