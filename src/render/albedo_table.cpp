#include "render/albedo_table.h"

#include <array>
#include <utility>

#include "gpu/commands.h"
#include "gpu/kernel.h"
#include "shared/scene.h"

namespace lavalight {

AlbedoTable makeAlbedoTable(gpu::Device& device, gpu::KernelCode code) {
    constexpr uint64_t bytes = uint64_t{kAlbedoRoughnesses} * kAlbedoRow * 16;
    const gpu::Buffer computed(device, "albedo table (computed)", bytes, gpu::BufferUse::storage);
    gpu::Buffer table(device, "albedo table", bytes, gpu::BufferUse::texels);
    gpu::ResourceTable resources;
    resources.set("AlbedoOut", computed);
    const gpu::Kernel kernel(device, std::move(code));
    const gpu::BoundKernel albedo(device, kernel, resources);
    gpu::Commands commands(device);
    commands.begin();
    for (const uint32_t isAverage : std::array<uint32_t, 2>{0, 1})
        commands.dispatch(albedo, kAlbedoRoughnesses, std::as_bytes(std::span(&isAverage, 1)));
    commands.copy(computed, table, bytes);
    commands.submitAndWait();
    return {std::move(table), kernel.code().spirv};
}

} // namespace lavalight
