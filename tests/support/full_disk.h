// A full disk, as far as a process can tell.
#pragma once

#include <csignal>
#include <cstddef>

#include <sys/resource.h>

namespace lavalight::test {

// While this lives, its process and those that it starts fail to make files longer than that, as on a full
// disk.
class FullDisk {
  public:
    explicit FullDisk(size_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit less{static_cast<rlim_t>(bytes), before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &less);
        std::signal(SIGXFSZ, SIG_IGN); // else the signal ends them
    }
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, SIG_DFL);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

  private:
    rlimit before_{};
};

} // namespace lavalight::test
