#include "device_scene/accelerator.h"

#include "device_scene/upload.h"

namespace lavalight {
namespace {

std::vector<TriangleRecord> inOrderOf(const AcceleratorData& data,
                                      std::span<const TriangleRecord> triangles) {
    std::vector<TriangleRecord> records;
    records.reserve(data.trianglesOfRecords().size());
    for (const uint32_t triangle : data.trianglesOfRecords())
        records.push_back(triangles[triangle]);
    return records;
}

} // namespace

std::vector<uint32_t> AcceleratorData::recordsOfTriangles(size_t triangles) const {
    std::vector<uint32_t> records(triangles);
    for (uint32_t record = 0; record < trianglesOfRecords().size(); ++record)
        records[trianglesOfRecords()[record]] = record;
    return records;
}

AcceleratorData buildAccelerator(std::span<const Triangle> triangles) {
    return {buildBvh(triangles)};
}

Accelerator::Accelerator(gpu::Device& device, const AcceleratorData& data,
                         std::span<const TriangleRecord> triangles)
    : buildSeconds_(data.bvh.buildSeconds), nodes_(uploadTexels(device, "BVH nodes", data.bvh.nodes)),
      triangles_(uploadTexels(device, "triangles", inOrderOf(data, triangles))) {}

void Accelerator::addTo(gpu::ResourceTable& resources) const {
    resources.set("bvhNodes", nodes_);
    resources.set("triangles", triangles_);
}

} // namespace lavalight
