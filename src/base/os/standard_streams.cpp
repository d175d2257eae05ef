#include "base/os/standard_streams.h"

#include <array>

#include <fcntl.h>
#include <unistd.h>

namespace lavalight {

void holdStandardStreams() {
    // In the order of their numbers: open() returns the lowest that is free.
    const std::array<const char*, 3> files = {"/dev/null", "/dev/full", "/dev/null"};
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream)
        if (::fcntl(stream, F_GETFD) == -1)
            (void)::open(files[static_cast<size_t>(stream)], O_RDWR);
}

} // namespace lavalight
