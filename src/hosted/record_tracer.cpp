#include "hosted/record_tracer.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "base/parallel.h"
#include "hosted/record_planes.h"
#include "shared/scene.h"

namespace lavalight {
namespace {

constexpr uint32_t kRecordsPerChunk = 1024;
constexpr size_t kChunksSortedAlone = 4; // in the time that it takes to wake a thread
constexpr uint8_t kEnded = 0xff;         // in the place of a region
// Features with which a kernel takes the rays that meet nothing.
constexpr SceneFeatures kEndsInKernels =
    kFeatureEnvironment | kFeatureEnvironmentMap | kFeatureBackground | kFeatureShadowCatcher;

glm::vec3 xyz(const glm::uvec4& words) {
    return glm::uintBitsToFloat(glm::uvec3(words));
}

// After so many vertices a path has found all direct light: recordDirect() of the shaders, in which radiance
// is not summed.
constexpr uint32_t kVerticesOfDirectLight = 2;

void keepDirect(PathLayers& layers, const glm::vec3& radiance) {
    layers.direct = radiance;
    layers.isPastDirect = 1;
}

} // namespace

// Neighbouring records, which one thread takes.
struct RecordTracer::Chunk {
    uint32_t first = 0;
    uint32_t end = 0;
    Regions counts{}; // of its records, by the region that they go to
    Regions places{}; // where the first of each goes
    uint64_t shadowRays = 0;
    uint64_t rays = 0;
};

RecordTracer::RecordTracer(const HostScene& scene, std::span<const uint8_t> classOfMaterials,
                           uint32_t classes, uint32_t waveSize)
    : scene_(scene), classOfMaterials_(classOfMaterials), escapes_(static_cast<uint8_t>(classes)),
      planes_(recordPlanes(scene.features)), hits_(waveSize), regions_(waveSize) {
    assert(classes < kMostRegions);
    if ((planes_ & kRecordInterior) != 0)
        insides_.resize(waveSize);
}

RecordTracer::Regions RecordTracer::advance(const RecordBuffers& buffers, uint32_t count, uint32_t bounce) {
    std::vector<Chunk> chunks;
    for (uint32_t first = 0; first < count; first += kRecordsPerChunk)
        chunks.push_back({first, std::min(count, first + kRecordsPerChunk)});
    forEachInParallel(chunks.size(), [&](size_t i) { trace(buffers, bounce, chunks[i]); });
    Regions totals{};
    shadowRays_ = rays_ = 0;
    for (const Chunk& chunk : chunks) {
        shadowRays_ += chunk.shadowRays;
        rays_ += chunk.rays;
    }
    uint32_t place = 0;
    for (size_t region = 0; region < totals.size(); ++region)
        for (Chunk& chunk : chunks) {
            chunk.places[region] = place;
            place += chunk.counts[region];
            totals[region] += chunk.counts[region];
        }
    if (chunks.size() <= kChunksSortedAlone)
        for (const Chunk& chunk : chunks)
            sort(buffers, chunk);
    else
        forEachInParallel(chunks.size(), [&](size_t i) { sort(buffers, chunks[i]); });
    return totals;
}

// Rays of one kind at a time: the processor's caches of code and branches hold one traversal.
void RecordTracer::trace(const RecordBuffers& buffers, uint32_t bounce, Chunk& chunk) {
    HostRays rays(scene_, frame_, range_);
    std::array<uint32_t, kRecordsPerChunk> withShadowRay;
    std::array<uint32_t, kRecordsPerChunk> goingOn;
    for (uint32_t i = chunk.first; i < chunk.end; ++i) {
        const uint32_t flags = buffers.at(kPlaneOrigin, i).w;
        if (bounce == 0)
            buffers.path(i) = {.throughput = {}, .bsdfPdf = 0.0f, .radiance = {}, .etaScale = 1.0f};
        withShadowRay[chunk.shadowRays] = goingOn[chunk.rays] = i;
        chunk.shadowRays += (flags & kRecordHasShadowRay) != 0 ? 1 : 0;
        chunk.rays += (flags & kRecordGoesOn) != 0 ? 1 : 0;
        regions_[i] = kEnded;
        if ((flags & kRecordEmits) != 0)
            buffers.path(i).radiance += xyz(buffers.at(kPlaneEmitted, i));
        if ((flags & kRecordIsCaught) != 0) {
            buffers.path(i).etaScale = kCaught;
            buffers.path(i).throughput = xyz(buffers.at(kPlaneContribution, i));
        }
        if (bounce == kVerticesOfDirectLight && !buffers.layers.empty())
            keepDirect(buffers.layers[buffers.slot(i)], buffers.path(i).radiance);
    }
    connect(buffers, bounce, rays, std::span(withShadowRay).first(chunk.shadowRays));
    extend(buffers, bounce, rays, std::span(goingOn).first(chunk.rays));
    for (const uint32_t i : std::span(goingOn).first(chunk.rays))
        if (regions_[i] != kEnded)
            ++chunk.counts[regions_[i]];
}

void RecordTracer::readShadowRay(const RecordBuffers& buffers, uint32_t record, ShadowRay& ray) const {
    const uint32_t originPlane = (planes_ & kRecordShadowOrigin) != 0 ? kPlaneShadowOrigin : kPlaneOrigin;
    const glm::uvec4& direction = buffers.at(kPlaneShadow, record);
    ray.origin = xyz(buffers.at(originPlane, record));
    ray.fromSurface = buffers.surfaceBefore(record);
    ray.direction = xyz(direction);
    ray.toSurface.primitive = direction.w;
}

// Adds what the records' shadow rays bring.
void RecordTracer::connect(const RecordBuffers& buffers, uint32_t bounce, HostRays& rays,
                           std::span<const uint32_t> records) const {
    std::vector<uint32_t> slots(records.size());
    std::vector<ShadowRay> traced(records.size());
    for (size_t i = 0; i < records.size(); ++i) {
        slots[i] = buffers.slot(records[i]);
        readShadowRay(buffers, records[i], traced[i]);
        __builtin_prefetch(&buffers.paths[slots[i]]); // anywhere in memory, and written below
    }
    std::vector<uint8_t> occluded(records.size());
    rays.findOccluded(bounce - 1, slots, traced, occluded);
    for (size_t i = 0; i < records.size(); ++i) {
        if (occluded[i] != 0)
            continue;
        Path& path = buffers.paths[slots[i]];
        if (path.etaScale == kCaught)
            path.throughput.y = path.throughput.x;
        else
            path.radiance += xyz(buffers.at(kPlaneContribution, records[i]));
    }
}

void RecordTracer::readRay(const RecordBuffers& buffers, uint32_t record, Ray& ray) const {
    ray.origin = xyz(buffers.at(kPlaneOrigin, record));
    ray.fromSurface = buffers.surfaceBefore(record);
    ray.direction = xyz(buffers.at(kPlaneDirection, record));
    if (!insides_.empty()) {
        const glm::uvec4& inside = buffers.at(kPlaneInterior, record);
        ray.interior = {inside.x, inside.y, inside.z};
    }
}

// Traces the next rays of records.
void RecordTracer::extend(const RecordBuffers& buffers, uint32_t bounce, HostRays& rays,
                          std::span<const uint32_t> records) {
    std::vector<uint32_t> slots(records.size());
    std::vector<Ray> traced(records.size());
    for (size_t i = 0; i < records.size(); ++i) {
        slots[i] = buffers.slot(records[i]);
        readRay(buffers, records[i], traced[i]);
    }
    std::vector<HostHit> hits(records.size());
    rays.trace(bounce, bounce == 0 ? Likeness::alike : Likeness::unlike, slots, traced, hits);
    for (size_t i = 0; i < records.size(); ++i)
        regions_[records[i]] = take(buffers, bounce, records[i], hits[i], traced[i]);
}

// Keeps what the record's ray has met; returns the region where it goes, or kEnded.
uint8_t RecordTracer::take(const RecordBuffers& buffers, uint32_t bounce, uint32_t record, const HostHit& met,
                           const Ray& ray) {
    const Hit& hit = met.hit;
    if (!insides_.empty())
        insides_[record] = ray.interior;
    hits_[record] = {glm::floatBitsToUint(hit.t), hit.record, glm::floatBitsToUint(hit.barycentrics)};
    if (hit.t < std::numeric_limits<float>::infinity())
        return classOfMaterials_[met.material];
    if (bounce == 0)
        buffers.path(record).etaScale = kUncovered;
    if ((scene_.features & kEndsInKernels) != 0)
        return escapes_;
    // A throughput of NaN or infinity times the darkness: the film drops the sample. Other paths are left
    // alone, since they lie anywhere in memory.
    const glm::vec3 nothing = 0.0f * xyz(buffers.at(kPlaneThroughput, record));
    if (nothing != glm::vec3(0.0f))
        buffers.path(record).radiance += nothing;
    return kEnded;
}

void RecordTracer::sort(const RecordBuffers& buffers, const Chunk& chunk) const {
    Regions places = chunk.places;
    const size_t stride = buffers.stride;
    for (uint32_t i = chunk.first; i < chunk.end; ++i) {
        if (regions_[i] == kEnded)
            continue;
        const uint32_t to = places[regions_[i]]++;
        for (const uint32_t plane : {kPlaneDirection, kPlaneThroughput, kPlaneOrigin})
            buffers.read[plane * stride + to] = buffers.written[plane * stride + i];
        buffers.read[kPlaneOrigin * stride + to].w &= kRecordSlotMask;
        buffers.read[kPlaneHit * stride + to] = hits_[i];
        if ((planes_ & kRecordState) != 0)
            buffers.read[kPlaneState * stride + to] = buffers.written[kPlaneState * stride + i];
        if (!insides_.empty())
            buffers.read[kPlaneInterior * stride + to] = {insides_[i].outer, insides_[i].inner,
                                                          insides_[i].notes, 0};
    }
}

} // namespace lavalight
