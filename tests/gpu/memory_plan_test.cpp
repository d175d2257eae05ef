// Where buffers go on other devices, by the memory that their drivers report.
#include "gpu/memory_plan.h"

#include <array>

#include <gtest/gtest.h>

namespace lavalight::gpu {
namespace {

using Memory = vk::MemoryPropertyFlagBits;
using Properties = vk::PhysicalDeviceMemoryProperties;

constexpr uint64_t kMiB = uint64_t{1} << 20;
constexpr uint64_t kGiB = uint64_t{1} << 30;
constexpr vk::MemoryPropertyFlags kLocal = Memory::eDeviceLocal;
constexpr vk::MemoryPropertyFlags kMapped = Memory::eHostVisible | Memory::eHostCoherent;
constexpr std::array<uint64_t, 4> kEmpty{};

void addHeap(Properties& memory, uint64_t bytes, bool isLocal) {
    memory.memoryHeaps[memory.memoryHeapCount++] =
        vk::MemoryHeap(bytes, isLocal ? vk::MemoryHeapFlagBits::eDeviceLocal : vk::MemoryHeapFlags());
}

void addType(Properties& memory, vk::MemoryPropertyFlags flags, uint32_t heap) {
    memory.memoryTypes[memory.memoryTypeCount++] = vk::MemoryType(flags, heap);
}

// A graphics card. Heaps: the card's, the host's, and a window to the card's. Types: 0 local, 1 host, 2 host
// and cached, 3 window.
Properties card(uint64_t windowBytes) {
    Properties memory;
    addHeap(memory, 8 * kGiB, true);
    addHeap(memory, 16 * kGiB, false);
    addHeap(memory, windowBytes, true);
    addType(memory, kLocal, 0);
    addType(memory, kMapped, 1);
    addType(memory, kMapped | Memory::eHostCached, 1);
    addType(memory, kLocal | kMapped, 2);
    return memory;
}

Properties integrated() {
    Properties memory;
    addHeap(memory, 12 * kGiB, true);
    addType(memory, kLocal, 0);
    addType(memory, kLocal | kMapped, 0);
    addType(memory, kLocal | kMapped | Memory::eHostCached, 0);
    return memory;
}

Properties lavapipe() {
    Properties memory;
    addHeap(memory, 2 * kGiB, true);
    addType(memory, kLocal | kMapped | Memory::eHostCached, 0);
    return memory;
}

MemoryPlan best(const Properties& memory, BufferUse use, uint64_t bytes = kMiB) {
    return planMemory(memory, kEmpty, {use, bytes}).at(0);
}

TEST(MemoryPlan, ACardWithASmallWindowGetsItsBuffersThroughStaging) {
    const Properties memory = card(256 * kMiB);
    for (const BufferUse use : {BufferUse::storage, BufferUse::texels})
        EXPECT_EQ(best(memory, use), (MemoryPlan{0, 0, false, false}));
    EXPECT_EQ(best(memory, BufferUse::uniform), (MemoryPlan{3, 2, true, false})) << "a few words may take it";
    EXPECT_EQ(best(memory, BufferUse::readback), (MemoryPlan{2, 1, true, true})) << "cached";
}

TEST(MemoryPlan, ACardWithResizableBarIsWrittenDirectlyAndReadThroughStaging) {
    const Properties memory = card(8 * kGiB);
    for (const BufferUse use : {BufferUse::storage, BufferUse::texels, BufferUse::uniform})
        EXPECT_EQ(best(memory, use), (MemoryPlan{3, 2, true, false}));
    EXPECT_EQ(best(memory, BufferUse::readback), (MemoryPlan{2, 1, true, true}));
}

TEST(MemoryPlan, AFullHeapComesAfterTheOthers) {
    const Properties memory = card(8 * kGiB);
    const std::array<uint64_t, 3> used{0, 0, 8 * kGiB - kMiB};
    EXPECT_EQ(planMemory(memory, used, {BufferUse::storage, kMiB}).at(0).type, 3u) << "it just fits";
    EXPECT_EQ(planMemory(memory, used, {BufferUse::storage, kMiB + 1}).at(0),
              (MemoryPlan{0, 0, false, false}));
    const std::array<uint64_t, 3> all{8 * kGiB, 0, 8 * kGiB};
    const std::vector<MemoryPlan> plans = planMemory(memory, all, {BufferUse::storage, kMiB});
    ASSERT_EQ(plans.size(), 4u);
    EXPECT_EQ(plans[0], (MemoryPlan{1, 1, true, false})) << "of the host";
    EXPECT_EQ(plans[2].heap, 2u) << "full ones are tried all the same, the best first";
    EXPECT_EQ(planMemory(card(256 * kMiB), kEmpty, {BufferUse::uniform, 300 * kMiB}).at(0).type, 0u);
}

TEST(MemoryPlan, IntegratedGpusAreWrittenDirectlyAndReadFromCachedMemory) {
    EXPECT_EQ(best(integrated(), BufferUse::storage), (MemoryPlan{1, 0, true, false}));
    EXPECT_EQ(best(integrated(), BufferUse::readback), (MemoryPlan{2, 0, true, true}));
}

TEST(MemoryPlan, SoftwareIsWrittenAndReadDirectly) {
    for (const BufferUse use :
         {BufferUse::storage, BufferUse::texels, BufferUse::uniform, BufferUse::readback})
        EXPECT_EQ(planMemory(lavapipe(), kEmpty, {use, kMiB}),
                  (std::vector<MemoryPlan>{MemoryPlan{0, 0, true, true}}));
}

TEST(MemoryPlan, StagingMayBeAskedForButForWhatTheHostReads) {
    const auto staged = [](BufferUse use) {
        return planMemory(lavapipe(), kEmpty, {use, kMiB, ~0u, true}).at(0);
    };
    EXPECT_EQ(staged(BufferUse::storage), (MemoryPlan{0, 0, false, false}));
    EXPECT_EQ(staged(BufferUse::readback), (MemoryPlan{0, 0, true, true}));
}

TEST(MemoryPlan, OnlyTypesThatTheBufferAllowsServe) {
    EXPECT_EQ(planMemory(card(8 * kGiB), kEmpty, {BufferUse::texels, kMiB, 0b0011u}).at(0).type, 0u);
    EXPECT_TRUE(planMemory(card(8 * kGiB), kEmpty, {BufferUse::readback, kMiB, 0b0001u}).empty());
}

} // namespace
} // namespace lavalight::gpu
