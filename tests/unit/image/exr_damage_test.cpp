// Damaged files are refused with one line, or read, and never crash the reader.
#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "base/file.h"
#include "support/exr_files.h"
#include "support/temporary_folder.h"

namespace lavalight::test {
namespace {

namespace fs = std::filesystem;

TEST(ExrDamage, PathsThatAreNoImagesAreRefused) {
    const TemporaryFolder folder;
    writeFileAtomically(folder / "empty.exr", "");
    writeFileAtomically(folder / "text.exr", "this is no image");
    for (const fs::path& path :
         {folder / "none.exr", folder.path(), folder / "empty.exr", folder / "text.exr"})
        expectOneLineNaming(readError(path), path);
}

TEST(ExrDamage, EveryTruncationIsRefused) {
    const TemporaryFolder folder;
    writeExr(folder / "whole.exr", sampleRendering(16, 40), {{"seed", "7"}});
    const std::string bytes = readFile(folder / "whole.exr");
    for (size_t size = 0; size < bytes.size(); size += size < 1200 ? 7 : 501) {
        writeFileAtomically(folder / "cut.exr", std::string_view(bytes).substr(0, size));
        expectOneLineNaming(readError(folder / "cut.exr"), folder / "cut.exr");
    }
}

TEST(ExrDamage, DamagedBytesNeverCrashTheReader) {
    const TemporaryFolder folder;
    writeExr(folder / "whole.exr", sampleRendering(8, 20), {{"seed", "7"}});
    const std::string bytes = readFile(folder / "whole.exr");
    std::mt19937 generator(11);
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string damaged = bytes;
        for (int k = 0; k < 3; ++k)
            damaged[generator() % damaged.size()] = static_cast<char>(generator());
        writeFileAtomically(folder / "damaged.exr", damaged);
        const std::string message = readError(folder / "damaged.exr");
        if (!message.empty()) {
            expectOneLineNaming(message, folder / "damaged.exr");
            ++refused;
        }
    }
    EXPECT_GT(refused, 100); // damage to pixels may go unnoticed, damage to headers and compressed data not
}

// The data window is the value of an attribute: 4 little-endian integers xMin yMin xMax yMax after its name
// and type.
void setDataWindow(std::string& bytes, const std::array<int32_t, 4>& window) {
    const std::string name("dataWindow\0box2i\0\x10\0\0\0", 21);
    const size_t at = bytes.find(name);
    ASSERT_NE(at, std::string::npos);
    for (size_t i = 0; i < 4; ++i)
        for (size_t k = 0; k < 4; ++k)
            bytes[at + name.size() + 4 * i + k] =
                static_cast<char>(static_cast<uint32_t>(window[i]) >> (8 * k));
}

TEST(ExrDamage, HeadersThatClaimAbsurdSizesAreRefusedWithoutAllocatingThem) {
    const TemporaryFolder folder;
    writeExr(folder / "whole.exr", sampleRendering(8, 20), {});
    const std::string bytes = readFile(folder / "whole.exr");
    constexpr int32_t kMax = std::numeric_limits<int32_t>::max();
    constexpr int32_t kMin = std::numeric_limits<int32_t>::min();
    const std::array<std::array<int32_t, 4>, 7> windows = {{{0, 0, 16384, 0},
                                                            {0, 0, 0, 16384},
                                                            {0, 0, kMax, kMax},
                                                            {kMin, kMin, kMax, kMax},
                                                            {5, 5, 4, 4},
                                                            {0, 0, 1 << 29, 19},
                                                            {0, 0, 16383, 16383}}};
    for (const auto& window : windows) {
        SCOPED_TRACE(testing::Message()
                     << window[0] << " " << window[1] << " " << window[2] << " " << window[3]);
        std::string claimed = bytes;
        setDataWindow(claimed, window);
        writeFileAtomically(folder / "claimed.exr", claimed);
        expectOneLineNaming(readError(folder / "claimed.exr"), folder / "claimed.exr");
    }
}

TEST(ExrDamage, AnAttributeThatClaimsGigabytesIsRefusedByItsName) {
    const TemporaryFolder folder;
    writeExr(folder / "whole.exr", sampleRendering(8, 20), {{"seed", "7"}});
    std::string bytes = readFile(folder / "whole.exr");
    const std::string name("lavalight:seed\0string\0", 22);
    const size_t size = bytes.find(name) + name.size(); // a little-endian 32-bit integer
    bytes[size + 3] = '\x7f';
    writeFileAtomically(folder / "claimed.exr", bytes);
    expectOneLineNaming(readError(folder / "claimed.exr"), folder / "claimed.exr");
    EXPECT_NE(readError(folder / "claimed.exr").find("lavalight:seed"), std::string::npos);
}

TEST(ExrDamage, BrokenFilesAreRefusedOrReadButNeverCrash) {
    if (assetFolder().empty())
        GTEST_SKIP() << "LAVALIGHT_ASSETS is not set";
    for (const auto& entry : fs::directory_iterator(assetFolder() / "invalid/generated/env")) {
        const std::string message = readError(entry.path());
        const bool mayLoad = entry.path().filename() == "exr_corrupt.exr";
        if (!mayLoad || !message.empty())
            expectOneLineNaming(message, entry.path());
    }
}

} // namespace
} // namespace lavalight::test
