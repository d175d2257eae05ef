#include "device_scene/accelerator.h"

#include <algorithm>
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

float largestCoordinate(std::span<const TriangleRecord> triangles) {
    glm::vec3 largest(0.0f);
    for (const TriangleRecord& t : triangles)
        largest = glm::max(largest, glm::max(glm::abs(t.v0), glm::max(glm::abs(t.v1), glm::abs(t.v2))));
    return std::max({largest.x, largest.y, largest.z});
}

} // namespace

std::string_view kernelAccelerator(AcceleratorKind kind) {
    return kind == AcceleratorKind::rayQuery ? kRayQuery : kBvh8;
}

std::vector<uint32_t> AcceleratorData::trianglesOfRecords(size_t triangles) const {
    if (kind == AcceleratorKind::bvh8)
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
    if (kind == AcceleratorKind::bvh16)
        return "bvh16";
    return embree ? EmbreeTriangles::identity() : std::string(kernelAccelerator(kind));
}

AcceleratorData buildAccelerator(std::span<const Triangle> triangles, std::span<const uint32_t> materials,
                                 AcceleratorKind kind) {
    AcceleratorData data{kind};
    if (kind == AcceleratorKind::bvh8)
        data.bvh = buildBvh(triangles);
    if (kind == AcceleratorKind::bvh16)
        data.bvh16 = std::make_shared<const Bvh16>(buildBvh16(triangles, materials));
    if (kind == AcceleratorKind::embree)
        data.embree =
            std::make_shared<const EmbreeTriangles>(triangles, RTC_BUILD_QUALITY_HIGH, kTracedByHost);
    return data;
}

Accelerator::Accelerator(gpu::Device& device, const AcceleratorData& data,
                         std::span<const TriangleRecord> triangles)
    : kind_(data.kind), bvhSeconds_(data.bvh16 ? data.bvh16->buildSeconds : data.bvh.buildSeconds),
      bvh16_(data.bvh16), embree_(data.embree), nodes_(uploadTexels(device, "BVH nodes", data.bvh.nodes)),
      triangles_(uploadTexels(device, "triangles", inOrderOf(data, triangles), gpu::BufferUse::corners)),
      extent_(uploadTexels(device, "extent of the structure",
                           std::vector{glm::vec4(largestCoordinate(triangles), 0.0f, 0.0f, 0.0f)})) {
    static_assert(sizeof(TriangleRecord) == gpu::TriangleStructure::kTriangleBytes);
    if (kind_ == AcceleratorKind::rayQuery)
        structure_.emplace(device, triangles_, triangles.size());
}

double Accelerator::buildSeconds() const {
    return embree_ ? embree_->buildSeconds() : structure_ ? structure_->buildSeconds() : bvhSeconds_;
}

uint64_t Accelerator::bytes() const {
    return nodes_.bytes() + triangles_.bytes() + (bvh16_ ? bvh16_->bytes() : 0) +
           (embree_ ? embree_->bytes() : 0) + (structure_ ? structure_->bytes() : 0);
}

void Accelerator::addTo(gpu::ResourceTable& resources) const {
    resources.set("bvhNodes", nodes_);
    resources.set("triangles", triangles_);
    if (structure_)
        resources.set("triangleStructure", *structure_);
    resources.set("structureExtent", extent_);
}

} // namespace lavalight
