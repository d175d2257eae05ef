// What is kept from run to run is found again, or not at all.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "base/user_cache.h"
#include "support/environment_variable.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;
using test::EnvironmentVariable;
using test::TemporaryFolder;

size_t filesIn(const fs::path& folder) {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(UserCache, FindsWhatWasKeptInThisAndInAnotherRun) {
    const TemporaryFolder folder;
    const UserCache cache(folder / "new/folder", 1000);
    EXPECT_FALSE(cache.find("a"));
    const std::string bytes("one\0two", 7);
    cache.keep("a", bytes);
    cache.keep("b", "");
    EXPECT_EQ(cache.find("a"), bytes);
    EXPECT_EQ(UserCache(folder / "new/folder", 1000).find("b"), "");
    cache.keep("a", "other");
    EXPECT_EQ(cache.find("a"), "other");
    EXPECT_EQ(filesIn(folder / "new/folder"), 2u); // nothing unfinished is left
}

TEST(UserCache, DamagedFilesAreNotFound) {
    const TemporaryFolder folder;
    const UserCache cache(folder.path(), 1000);
    cache.keep("a", "some bytes");
    fs::resize_file(folder / "a", fs::file_size(folder / "a") - 1);
    EXPECT_FALSE(cache.find("a"));
    cache.keep("a", "some bytes");
    std::fstream(folder / "a", std::ios::in | std::ios::out | std::ios::binary)
        .seekp(-1, std::ios::end)
        .put('S');
    EXPECT_FALSE(cache.find("a"));
    std::ofstream(folder / "a") << "short";
    EXPECT_FALSE(cache.find("a"));
}

TEST(UserCache, FilesThatWereNotUsedForLongestGoFirst) {
    const TemporaryFolder folder;
    const UserCache cache(folder.path(), 500);
    const std::string bytes(100, 'x');
    const auto now = fs::file_time_type::clock::now();
    for (int i = 1; i <= 4; ++i) {
        const std::string key = std::to_string(i);
        cache.keep(key, bytes);
        fs::last_write_time(folder / key, now - std::chrono::hours(5 - i));
    }
    EXPECT_TRUE(cache.find("1")); // used just now
    cache.keep("10", bytes);      // a key at which it looks
    EXPECT_FALSE(cache.find("2"));
    EXPECT_FALSE(cache.find("3"));
    EXPECT_TRUE(cache.find("1"));
    EXPECT_TRUE(cache.find("4"));
    EXPECT_TRUE(cache.find("10"));
}

TEST(UserCache, KeepsNothingAndSaysNothingWhereItCannot) {
    const TemporaryFolder folder;
    std::ofstream(folder / "file") << "x";
    const UserCache below(folder / "file/folder", 1000);
    below.keep("a", "bytes");
    EXPECT_FALSE(below.find("a"));
    const UserCache none(std::nullopt, 1000);
    none.keep("a", "bytes");
    EXPECT_FALSE(none.find("a"));
}

TEST(UserCache, FolderIsThatOfTheVariables) {
    const EnvironmentVariable home("HOME", "/home/someone");
    const EnvironmentVariable noXdg("XDG_CACHE_HOME", "");
    const EnvironmentVariable noName("LAVALIGHT_CACHE", "");
    EXPECT_EQ(userCacheFolder("kernels"), fs::path("/home/someone/.cache/lavalight/kernels"));
    const EnvironmentVariable xdg("XDG_CACHE_HOME", "/var/someone");
    EXPECT_EQ(userCacheFolder("kernels"), fs::path("/var/someone/lavalight/kernels"));
    const EnvironmentVariable name("LAVALIGHT_CACHE", "/scratch");
    EXPECT_EQ(userCacheFolder("kernels"), fs::path("/scratch/kernels"));
    const EnvironmentVariable off("LAVALIGHT_CACHE", "off");
    EXPECT_FALSE(userCacheFolder("kernels"));
}

} // namespace
} // namespace lavalight
