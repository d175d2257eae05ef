#include "gpu/memory_plan.h"

#include <algorithm>

namespace lavalight::gpu {
namespace {

using Memory = vk::MemoryPropertyFlagBits;

constexpr vk::MemoryPropertyFlags kMappable = Memory::eHostVisible | Memory::eHostCoherent;

uint64_t largestDeviceHeap(const vk::PhysicalDeviceMemoryProperties& memory) {
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & vk::MemoryHeapFlagBits::eDeviceLocal)
            bytes = std::max<uint64_t>(bytes, memory.memoryHeaps[i].size);
    return bytes;
}

// Properties of memory that serves, best first.
std::vector<vk::MemoryPropertyFlags> wishes(BufferUse use) {
    if (use == BufferUse::readback)
        return {kMappable | Memory::eHostCached, kMappable};
    return {kMappable | Memory::eDeviceLocal, Memory::eDeviceLocal, kMappable};
}

} // namespace

std::vector<MemoryPlan> planMemory(const vk::PhysicalDeviceMemoryProperties& memory,
                                   std::span<const uint64_t> used, const MemoryWish& wish) {
    const uint64_t deviceHeap = largestDeviceHeap(memory);
    std::vector<MemoryPlan> plans;
    std::vector<MemoryPlan> full;
    const auto isPlanned = [&](uint32_t type) {
        const auto hasType = [&](const MemoryPlan& plan) { return plan.type == type; };
        return std::ranges::any_of(plans, hasType) || std::ranges::any_of(full, hasType);
    };
    for (const vk::MemoryPropertyFlags flags : wishes(wish.use)) {
        const bool isWindow = flags == (kMappable | Memory::eDeviceLocal) && wish.use != BufferUse::uniform;
        for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
            const vk::MemoryPropertyFlags has = memory.memoryTypes[type].propertyFlags;
            const uint32_t heap = memory.memoryTypes[type].heapIndex;
            const uint64_t bytes = memory.memoryHeaps[heap].size;
            if ((wish.typeBits >> type & 1u) == 0 || (has & flags) != flags || isPlanned(type) ||
                (isWindow && bytes < deviceHeap))
                continue;
            const bool isMapped =
                (has & kMappable) == kMappable && !(wish.mustBeStaged && wish.use != BufferUse::readback);
            const bool isReadMapped =
                isMapped && ((has & Memory::eHostCached) || wish.use == BufferUse::readback);
            const bool fits = wish.bytes <= bytes && used[heap] <= bytes - wish.bytes;
            (fits ? plans : full).push_back({type, heap, isMapped, isReadMapped});
        }
    }
    plans.insert(plans.end(), full.begin(), full.end());
    return plans;
}

} // namespace lavalight::gpu
