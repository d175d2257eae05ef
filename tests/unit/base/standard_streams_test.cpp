// Streams that were closed are opened, so that no file takes their place.
#include "base/os/standard_streams.h"

#include <cerrno>

#include <fcntl.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace lavalight::test {
namespace {

// In a process of its own, which ends with 0 if all is as it should be.
[[noreturn]] void closeAndHold() {
    for (const int stream : {0, 1, 2})
        ::close(stream);
    holdStandardStreams();
    const int file = ::open("/dev/null", O_RDWR);
    char byte = 'x';
    if (file <= 2)
        ::_exit(1);
    if (::write(1, &byte, 1) != -1 || errno != ENOSPC)
        ::_exit(2);
    if (::write(2, &byte, 1) != 1 || ::read(0, &byte, 1) != 0)
        ::_exit(3);
    ::_exit(0);
}

TEST(StandardStreams, ThatAreClosedGiveTheirNumbersToNoFile) {
    EXPECT_EXIT(closeAndHold(), testing::ExitedWithCode(0), "");
}

// Nothing is opened where all streams are: the next file gets the number that it had got before.
TEST(StandardStreams, ThatAreOpenStay) {
    const int before = ::open("/dev/null", O_RDWR);
    ::close(before);
    holdStandardStreams();
    const int after = ::open("/dev/null", O_RDWR);
    ::close(after);
    EXPECT_EQ(after, before);
}

} // namespace
} // namespace lavalight::test
