// A limit on memory, for tests of what must be refused without enough of it.
#pragma once

#include <cstdint>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

namespace lavalight::test {

// While it lives, this process gets no more than `bytes` beyond what it has.
class MemoryLimit {
  public:
    explicit MemoryLimit(uint64_t bytes) {
        uint64_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        ::getrlimit(RLIMIT_AS, &before_);
        rlimit limit = before_;
        limit.rlim_cur = pages * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE)) + bytes;
        EXPECT_EQ(::setrlimit(RLIMIT_AS, &limit), 0);
    }
    ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &before_); }
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

    // AddressSanitizer takes terabytes of addresses for itself, as it goes.
    static constexpr bool isPossible() {
#if defined(__SANITIZE_ADDRESS__)
        return false;
#else
        return true;
#endif
    }

  private:
    rlimit before_{};
};

} // namespace lavalight::test
