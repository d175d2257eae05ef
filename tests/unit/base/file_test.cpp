// Files are read whole or refused with a reason, and written whole or not at all.
#include "base/file.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "support/temporary_folder.h"

namespace lavalight {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

// The message of the Error that `action` throws; empty if it throws none.
template <typename Action>
std::string errorOf(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

std::string readError(const fs::path& path) {
    return errorOf([&] { (void)readFile(path); });
}

std::string writeError(const fs::path& path) {
    return errorOf([&] { writeFileAtomically(path, "bytes"); });
}

TEST(ReadFile, ReturnsEveryByteThatWasWritten) {
    const TemporaryFolder folder;
    const std::string bytes("a\0b\r\n\xff", 6);
    writeFileAtomically(folder / "file", bytes);
    EXPECT_EQ(readFile(folder / "file"), bytes);
}

TEST(ReadFile, AnEmptyFileIsAnEmptyString) {
    const TemporaryFolder folder;
    writeFileAtomically(folder / "file", "");
    EXPECT_EQ(readFile(folder / "file"), "");
}

TEST(ReadFile, ErrorsSayWhatThePathIs) {
    const TemporaryFolder folder;
    EXPECT_EQ(readError(folder / "none"), "cannot read " + (folder / "none").string() + ": no such file");
    EXPECT_EQ(readError(""), "cannot read \"\": no file name given");
    EXPECT_NE(readError(folder.path()).find("it is a directory"), std::string::npos);
    EXPECT_NE(readError("/dev/zero").find("not a regular file"), std::string::npos);
    writeFileAtomically(folder / "file", "bytes");
    EXPECT_NE(readError(folder / "file" / "below").find("no such file"), std::string::npos);
    fs::create_symlink(folder / "loop", folder / "loop");
    EXPECT_NE(readError(folder / "loop").find("symbolic links"), std::string::npos);
}

TEST(WriteFileAtomically, ReplacesAFileAndLeavesNothingElse) {
    const TemporaryFolder folder;
    writeFileAtomically(folder / "file", "old and longer");
    writeFileAtomically(folder / "file", "new");
    EXPECT_EQ(readFile(folder / "file"), "new");
    EXPECT_EQ(folder.count(), 1);
}

TEST(WriteFileAtomically, AWriterThatThrowsLeavesTheOldFileAndNothingElse) {
    const TemporaryFolder folder;
    writeFileAtomically(folder / "file", "old");
    const auto writeHalf = [](const fs::path& part) {
        std::ofstream(part) << "half";
        throw Error("disk full");
    };
    EXPECT_EQ(errorOf([&] { writeFileAtomically(folder / "file", writeHalf); }), "disk full");
    EXPECT_EQ(readFile(folder / "file"), "old");
    EXPECT_EQ(folder.count(), 1);
}

TEST(WriteFileAtomically, TheNewNameAppearsOnlyWhenTheWriterIsDone) {
    const TemporaryFolder folder;
    writeFileAtomically(folder / "file", [&](const fs::path& part) {
        std::ofstream(part) << "bytes";
        EXPECT_EQ(part.parent_path(), folder.path());
        EXPECT_FALSE(fs::exists(folder / "file"));
    });
    EXPECT_TRUE(fs::exists(folder / "file"));
}

TEST(WriteFileAtomically, ErrorsSayWhyThePathCannotBeWritten) {
    const TemporaryFolder folder;
    EXPECT_NE(writeError(folder / "none" / "file").find("none does not exist"), std::string::npos);
    EXPECT_NE(writeError(folder.path()).find("it is a directory"), std::string::npos);
    EXPECT_NE(writeError(folder.path() / "").find("no file name given"), std::string::npos);
    EXPECT_NE(writeError("/proc/file").find("cannot write /proc/file: "), std::string::npos);
    EXPECT_EQ(folder.count(), 0);
}

TEST(WriteFileAtomically, DevicesAreNotReplaced) {
    const TemporaryFolder folder;
    fs::create_symlink("/dev/null", folder / "null"); // were the check broken, only this link would suffer
    EXPECT_NE(writeError(folder / "null").find("not a regular file"), std::string::npos);
    EXPECT_TRUE(fs::is_symlink(folder / "null"));
}

TEST(RequireWritable, PassesQuietlyWhereAFileCanBeMade) {
    const TemporaryFolder folder;
    requireWritable(folder / "file");
    EXPECT_EQ(folder.count(), 0);
    writeFileAtomically(folder / "file", "old");
    requireWritable(folder / "file");
    EXPECT_EQ(readFile(folder / "file"), "old");
    EXPECT_EQ(folder.count(), 1);
}

TEST(RequireWritable, ThrowsWhereAFileCannotBeMade) {
    const TemporaryFolder folder;
    EXPECT_THROW(requireWritable(folder / "none" / "file"), Error);
    EXPECT_THROW(requireWritable(folder.path()), Error);
    EXPECT_THROW(requireWritable("/proc/file"), Error);
    EXPECT_THROW(requireWritable("/dev/null"), Error);
    EXPECT_EQ(folder.count(), 0);
}

TEST(RemoveUnfinished, TakesWhatWritersOfThatFileLeftBehindAndNothingElse) {
    const TemporaryFolder folder;
    for (const char* name : {"file", "file.part", "file.1-0.part", "file.22-7.part", "file.1-0.txt",
                             "other.1-0.part", "afile.1-0.part"})
        writeFileAtomically(folder / name, "x");
    removeUnfinished(folder / "file");
    EXPECT_FALSE(fs::exists(folder / "file.1-0.part"));
    EXPECT_FALSE(fs::exists(folder / "file.22-7.part"));
    EXPECT_EQ(folder.count(), 5);
    removeUnfinished(folder / "none" / "file");
}

} // namespace
} // namespace lavalight
