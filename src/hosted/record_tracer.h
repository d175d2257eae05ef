// The host's half of the schedule "hosted": rays of records traced, and records sorted for the kernels.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "hosted/host_rays.h"
#include "shared/frame.h"
#include "shared/path_layers.h"
#include "shared/records.h"
#include "shared/wavefront.h"

namespace lavalight {

// The records that kernels wrote, those that they are to read, and the paths' sums.
struct RecordBuffers {
    std::span<const glm::uvec4> written; // kPlanesOut planes
    std::span<glm::uvec4> read;          // kPlanesIn planes
    std::span<Path> paths;               // by slot; what accumulate reads of them is used
    std::span<PathLayers> layers;        // by slot; empty: none are recorded
    size_t stride = 0;                   // records from one plane to the next

    // What kernels wrote of a record.
    [[nodiscard]] const glm::uvec4& at(uint32_t plane, uint32_t record) const {
        return written[plane * stride + record];
    }
    [[nodiscard]] uint32_t slot(uint32_t record) const {
        return at(kPlaneOrigin, record).w & kRecordSlotMask;
    }
    [[nodiscard]] Path& path(uint32_t record) const { return paths[slot(record)]; }
    // The surface that its rays start on, or kNoSurface: where the kernels found it.
    [[nodiscard]] SurfaceId surfaceBefore(uint32_t record) const {
        const bool isOnSurface = (at(kPlaneOrigin, record).w & kRecordOnSurface) != 0;
        return isOnSurface ? SurfaceId{read[kPlaneHit * stride + record].y} : kNoSurface;
    }
};

class RecordTracer {
  public:
    static constexpr uint32_t kMostRegions = 8;
    // Number of records in each region, which follow one another: those of each class of materials, in order,
    // then those whose rays met nothing.
    using Regions = std::array<uint32_t, kMostRegions>;

    // `classOfMaterials`: regions of the materials; the one after the last of `classes` is for rays that meet
    // nothing, unless nothing shines there. The span must outlive the tracer, as what the scene refers to.
    RecordTracer(const HostScene& scene, std::span<const uint8_t> classOfMaterials, uint32_t classes,
                 uint32_t waveSize);

    // Before the first bounce of a wave.
    void start(const FrameParameters& frame, const WaveRange& range) {
        frame_ = frame;
        range_ = range;
    }
    // Takes the first `count` records that kernels wrote after `bounce` vertices: starts their paths where
    // there is no vertex yet; adds what they emit, and what their shadow rays bring, to the paths' radiance;
    // traces their next rays; and sorts those that go on. No bit depends on the order of records, on threads
    // or on the wave.
    [[nodiscard]] Regions advance(const RecordBuffers& buffers, uint32_t count, uint32_t bounce);

    [[nodiscard]] uint64_t shadowRays() const { return shadowRays_; } // of the last advance()
    [[nodiscard]] uint64_t rays() const { return rays_; }             // alike

  private:
    struct Chunk;
    void trace(const RecordBuffers& buffers, uint32_t bounce, Chunk& chunk);
    void connect(const RecordBuffers& buffers, uint32_t bounce, HostRays& rays,
                 std::span<const uint32_t> records) const;
    void extend(const RecordBuffers& buffers, uint32_t bounce, HostRays& rays,
                std::span<const uint32_t> records);
    void readShadowRay(const RecordBuffers& buffers, uint32_t record, ShadowRay& ray) const;
    void readRay(const RecordBuffers& buffers, uint32_t record, Ray& ray) const;
    [[nodiscard]] uint8_t take(const RecordBuffers& buffers, uint32_t bounce, uint32_t record,
                               const HostHit& met, const Ray& ray);
    void sort(const RecordBuffers& buffers, const Chunk& chunk) const;

    HostScene scene_;
    std::span<const uint8_t> classOfMaterials_;
    uint8_t escapes_; // region of rays that met nothing
    uint32_t planes_; // kRecord... bits
    FrameParameters frame_{};
    WaveRange range_{};
    std::vector<glm::uvec4> hits_;      // of the records that kernels wrote
    std::vector<uint8_t> regions_;      // alike
    std::vector<InteriorList> insides_; // alike, with kRecordInterior: where the rays end
    uint64_t shadowRays_ = 0;
    uint64_t rays_ = 0;
};

} // namespace lavalight
