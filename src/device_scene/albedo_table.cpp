#include "device_scene/albedo_table.h"

#include <array>
#include <utility>

#include "gpu/commands.h"
#include "gpu/kernel.h"
#include "shared/scene.h"

namespace lavalight {

AlbedoTable makeAlbedoTable(gpu::Device& device, gpu::KernelCode code) {
    constexpr uint64_t bytes = uint64_t{kAlbedoEntries + kAlbedoAverages} * 16;
    constexpr uint64_t unrounded = uint64_t{kAlbedoEntries} * 16;
    const gpu::Buffer computed(device, "albedo table (computed)", bytes + unrounded, gpu::BufferUse::storage);
    gpu::Buffer table(device, "albedo table", bytes, gpu::BufferUse::texels);
    gpu::ResourceTable resources;
    resources.set("AlbedoOut", computed);
    const gpu::Kernel kernel(device, std::move(code));
    const gpu::BoundKernel albedo(device, kernel, resources);
    gpu::Commands commands(device);
    commands.begin();
    for (const uint32_t stage : std::array<uint32_t, 3>{0, 1, 2})
        commands.dispatch(albedo, kAlbedoRoughnesses, std::as_bytes(std::span(&stage, 1)));
    commands.copy(computed, table, bytes);
    commands.submitAndWait();
    return {std::move(table), kernel.code().content};
}

} // namespace lavalight
