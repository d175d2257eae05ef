// Tests of asking for memory before it is taken, and of giving it back.
#include "base/os/memory.h"

#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "base/error.h"
#include "base/file.h"
#include "support/memory_limit.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

constexpr uint64_t kGibibyte = uint64_t{1} << 30;

TEST(Memory, WhatIsThereIsNoShortageAndWhatNoMachineHasIsOne) {
    EXPECT_GT(availableMemory(), uint64_t{1} << 20);
    EXPECT_EQ(memoryShortage(1), "");
    EXPECT_EQ(memoryShortage(availableMemory() / 2), "");
    EXPECT_TRUE(memoryShortage(uint64_t{1} << 60).starts_with("take 1073741824.0 GiB of memory, "));
}

TEST(Memory, LimitOfTheProcessCounts) {
    if (!MemoryLimit::isPossible())
        GTEST_SKIP() << "memory cannot be limited here";
    const MemoryLimit limit(kGibibyte / 2);
    EXPECT_LE(availableMemory(), kGibibyte / 2);
    EXPECT_EQ(memoryShortage(2 * kGibibyte), "take 2.0 GiB of memory, 512 MiB are available");
}

// A sparse file of 2^40 bytes takes none of the disk.
TEST(Memory, FilesBeyondItAreRefusedByTheirSize) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "large.bin";
    writeFileAtomically(path, "x");
    std::filesystem::resize_file(path, uint64_t{1} << 40);
    try {
        (void)readFile(path);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("large.bin: its bytes take 1024.0 GiB of memory"),
                  std::string::npos)
            << error.what();
    }
}

#ifdef __GLIBC__
// Blocks that glibc has from the system and gives back to it. None with a sanitizer or valgrind, which have
// allocators of their own.
size_t mappedBlocks() {
    return mallinfo2().hblks;
}

TEST(Memory, LargeBlocksGoBackToTheSystemAfterLargerOnesWereFreed) {
    constexpr size_t kBytes = 8u << 20;
    struct Free {
        void operator()(void* block) const { std::free(block); }
    };
    using Block = std::unique_ptr<void, Free>;
    if (const size_t before = mappedBlocks(); Block(std::malloc(4 * kBytes)) && mappedBlocks() == before)
        GTEST_SKIP() << "another allocator";
    keepHeapSmall();
    Block(std::malloc(2 * kBytes)).reset(); // by itself, glibc would raise its limit now
    const size_t before = mappedBlocks();
    const Block block(std::malloc(kBytes));
    EXPECT_EQ(mappedBlocks(), before + 1);
}
#endif

} // namespace
} // namespace lavalight::test
