#include "device_scene/accelerator.h"

#include <numeric>

#include "device_scene/upload.h"

namespace lavalight {
namespace {

std::vector<TriangleRecord> inOrderOf(const AcceleratorData& data,
                                      std::span<const TriangleRecord> triangles) {
    std::vector<TriangleRecord> records;
    for (const uint32_t triangle : data.trianglesOfRecords(triangles.size()))
        records.push_back(triangles[triangle]);
    return records;
}

} // namespace

std::vector<uint32_t> AcceleratorData::trianglesOfRecords(size_t triangles) const {
    if (!embree)
        return bvh.leafTriangles;
    std::vector<uint32_t> records(triangles);
    std::iota(records.begin(), records.end(), 0u);
    return records;
}

std::vector<uint32_t> AcceleratorData::recordsOfTriangles(size_t triangles) const {
    const std::vector<uint32_t> ofRecords = trianglesOfRecords(triangles);
    std::vector<uint32_t> records(triangles);
    for (uint32_t record = 0; record < ofRecords.size(); ++record)
        records[ofRecords[record]] = record;
    return records;
}

std::string AcceleratorData::name() const {
    return embree ? EmbreeTriangles::identity() : std::string(kAcceleratorName);
}

AcceleratorData buildAccelerator(std::span<const Triangle> triangles, AcceleratorKind kind) {
    if (kind == AcceleratorKind::bvh8)
        return {buildBvh(triangles), nullptr};
    return {{}, std::make_shared<const EmbreeTriangles>(triangles, RTC_BUILD_QUALITY_HIGH, kTracedByHost)};
}

Accelerator::Accelerator(gpu::Device& device, const AcceleratorData& data,
                         std::span<const TriangleRecord> triangles)
    : buildSeconds_(data.embree ? data.embree->buildSeconds() : data.bvh.buildSeconds), embree_(data.embree),
      nodes_(uploadTexels(device, "BVH nodes", data.bvh.nodes)),
      triangles_(uploadTexels(device, "triangles", inOrderOf(data, triangles))) {}

void Accelerator::addTo(gpu::ResourceTable& resources) const {
    resources.set("bvhNodes", nodes_);
    resources.set("triangles", triangles_);
}

} // namespace lavalight
