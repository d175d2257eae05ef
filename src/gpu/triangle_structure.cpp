#include "gpu/triangle_structure.h"

#include <chrono>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "gpu/commands.h"

namespace lavalight::gpu {
namespace {

vk::TransformMatrixKHR identity() {
    vk::TransformMatrixKHR matrix;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 4; ++j)
            matrix.matrix[i][j] = i == j ? 1.0f : 0.0f;
    return matrix;
}

} // namespace

TriangleStructure::TriangleStructure(Device& device, const Buffer& corners, uint64_t triangles)
    : device_(&device) {
    if (!device.tracesRays())
        throw Error(fmt::format("cannot build an acceleration structure: {} has no VK_KHR_ray_query",
                                device.description().name));
    if (triangles > device.limits().maxTracedTriangles)
        throw Error(
            fmt::format("the scene has {} triangles, but {} allows {} in an acceleration structure; try "
                        "--accelerator bvh8",
                        triangles, device.description().name, device.limits().maxTracedTriangles));
    const auto start = std::chrono::steady_clock::now();
    checked("build", "an acceleration structure", [&] {
        if (triangles > 0)
            bottom_ = buildBottom(corners, static_cast<uint32_t>(triangles));
        top_ = buildTop();
    });
    buildSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TriangleStructure::Level TriangleStructure::build(vk::AccelerationStructureTypeKHR type,
                                                  const vk::AccelerationStructureGeometryKHR& geometry,
                                                  uint32_t primitives) {
    vk::AccelerationStructureBuildGeometryInfoKHR info(
        type, vk::BuildAccelerationStructureFlagBitsKHR::ePreferFastTrace,
        vk::BuildAccelerationStructureModeKHR::eBuild);
    info.setGeometries(geometry);
    const vk::AccelerationStructureBuildSizesInfoKHR sizes =
        device_->handle().getAccelerationStructureBuildSizesKHR(
            vk::AccelerationStructureBuildTypeKHR::eDevice, info, primitives);
    Level level{{*device_, "acceleration structure", sizes.accelerationStructureSize, BufferUse::structure}};
    level.handle = {device_->handle(),
                    vk::AccelerationStructureCreateInfoKHR({}, level.memory.handle(), 0,
                                                           sizes.accelerationStructureSize, type)};
    const uint64_t alignment = device_->limits().scratchAlignment;
    const Buffer scratch(*device_, "scratch of an acceleration structure", sizes.buildScratchSize + alignment,
                         BufferUse::structure);
    info.setDstAccelerationStructure(*level.handle);
    info.setScratchData((scratch.address() + alignment - 1) / alignment * alignment);
    Commands commands(*device_);
    commands.begin();
    commands.build(info, primitives);
    commands.submitAndWait();
    bytes_ += level.memory.bytes();
    return level;
}

TriangleStructure::Level TriangleStructure::buildBottom(const Buffer& corners, uint32_t triangles) {
    vk::AccelerationStructureGeometryTrianglesDataKHR data;
    data.vertexFormat = vk::Format::eR32G32B32Sfloat;
    data.vertexData = corners.address();
    data.vertexStride = kCornerBytes;
    data.maxVertex = 3 * triangles - 1;
    data.indexType = vk::IndexType::eNoneKHR;
    return build(vk::AccelerationStructureTypeKHR::eBottomLevel,
                 {vk::GeometryTypeKHR::eTriangles, data, vk::GeometryFlagsKHR()}, triangles);
}

TriangleStructure::Level TriangleStructure::buildTop() {
    vk::AccelerationStructureInstanceKHR instance(identity(), 0, 0xff, 0, vk::GeometryInstanceFlagsKHR());
    if (bottom_)
        instance.accelerationStructureReference = device_->handle().getAccelerationStructureAddressKHR(
            vk::AccelerationStructureDeviceAddressInfoKHR(*bottom_->handle));
    Buffer instances(*device_, "instances", sizeof(instance), BufferUse::structure);
    instances.upload(std::as_bytes(std::span(&instance, 1)));
    vk::AccelerationStructureGeometryInstancesDataKHR data;
    data.data = instances.address();
    return build(vk::AccelerationStructureTypeKHR::eTopLevel,
                 {vk::GeometryTypeKHR::eInstances, data, vk::GeometryFlagsKHR()}, bottom_ ? 1 : 0);
}

} // namespace lavalight::gpu
