// Locks between processes, and after one of them was killed.
#include <csignal>
#include <fstream>
#include <memory>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "base/os/file_lock.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;

// Whether another process could take it now.
bool canLock(const fs::path& file) {
    const pid_t child = ::fork();
    if (child == 0) {
        try {
            const FileLock lock(file);
            ::_exit(0);
        } catch (const Error&) {
            ::_exit(1);
        }
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return status == 0;
}

TEST(FileLock, IsOnesUntilItIsGivenBack) {
    const test::TemporaryFolder folder;
    const fs::path file = folder / "film.exr";
    auto lock = std::make_unique<FileLock>(file);
    EXPECT_FALSE(canLock(file));
    EXPECT_TRUE(canLock(folder / "other.exr"));
    try {
        const FileLock second(file);
        ADD_FAILURE() << "two have it";
    } catch (const Error& error) {
        EXPECT_EQ(error.what(),
                  file.string() + " is in use by another process (" + std::to_string(::getpid()) + ")");
    }
    lock.reset();
    EXPECT_FALSE(fs::exists(folder / "film.exr.lock"));
    EXPECT_TRUE(canLock(file));
}

TEST(FileLock, OfAKilledProcessDoesNotCount) {
    const test::TemporaryFolder folder;
    const fs::path file = folder / "film.exr";
    const pid_t child = ::fork();
    if (child == 0) {
        const FileLock lock(file);
        std::ofstream(folder / "has it") << "yes";
        ::pause();
        ::_exit(0);
    }
    while (!fs::exists(folder / "has it"))
        ::usleep(1000);
    EXPECT_FALSE(canLock(file));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ASSERT_TRUE(fs::exists(folder / "film.exr.lock"));
    EXPECT_TRUE(canLock(file));
}

TEST(FileLock, SaysWhatIsWrongWithTheFolder) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(FileLock(folder / "none/film.exr"), Error);
}

} // namespace
} // namespace lavalight
