// Which memory a buffer goes to, and how the host gets at it: a choice among what a device says it has.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <vulkan/vulkan.hpp>

namespace lavalight::gpu {

enum class BufferUse {
    storage,  // read and written by kernels; stays in the device's memory
    readback, // as storage, but mapped, for the few words that the host reads after each submission
    uniform,  // a few words that every invocation reads alike, at most 16 KiB
    texels,   // read by kernels as RGBA32UI texels (16 bytes an element) through a uniform texel view
    corners,  // as texels, and read by the device where it builds an acceleration structure, if it has those
    structure // an acceleration structure, and what the device builds it with
};

struct MemoryPlan {
    uint32_t type = 0;         // index for vkAllocateMemory
    uint32_t heap = 0;         // heap that the type belongs to
    bool isMapped = false;     // the host writes to it; otherwise through a staging buffer
    bool isReadMapped = false; // the host reads it where it lies; otherwise through a staging buffer
    bool operator==(const MemoryPlan&) const = default;
};

// A buffer to be made.
struct MemoryWish {
    BufferUse use = BufferUse::storage;
    uint64_t bytes = 0;
    uint32_t typeBits = ~0u; // types that VkMemoryRequirements allows
    // Goes through staging, as on a card whose memory the host cannot map; not for readback.
    bool mustBeStaged = false;
};

// Memory types that serve, best first: a heap that is full by `used` (bytes of each heap, in use by us) comes
// last. Memory that both sides reach is taken where it is as large as the device's own, as it is on CPUs,
// integrated GPUs and cards with resizable BAR. Without that, it is a window of 256 MiB: a few words of
// parameters go there, all else to the device's memory, through staging buffers. The host reads from cached
// memory alone: reads of uncached memory take a hundred times as long. Empty: nothing serves.
[[nodiscard]] std::vector<MemoryPlan> planMemory(const vk::PhysicalDeviceMemoryProperties& memory,
                                                 std::span<const uint64_t> used, const MemoryWish& wish);

} // namespace lavalight::gpu
