// Based on: proc(5), getrlimit(2) and the kernel's description of control groups, version 2.
#include "base/os/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __GLIBC__ // which the headers before this line say
#include <malloc.h>
#endif

namespace lavalight {
namespace {

constexpr uint64_t kUnlimited = std::numeric_limits<uint64_t>::max();
constexpr uint64_t kKibibyte = 1024;

// The number after `key` in a file of lines "key number".
std::optional<uint64_t> numberIn(const std::string& path, std::string_view key) {
    std::ifstream file(path);
    std::string line;
    while (std::getline(file, line)) {
        if (!line.starts_with(key))
            continue;
        const size_t digits = line.find_first_of("0123456789", key.size());
        if (digits != std::string::npos)
            return std::stoull(line.substr(digits));
    }
    return std::nullopt;
}

// Memory that the system has free or can give up at once, in bytes.
uint64_t systemMemory() {
    return numberIn("/proc/meminfo", "MemAvailable:").value_or(kUnlimited / kKibibyte) * kKibibyte;
}

// Bytes of address space that are left where `ulimit -v` bounds it.
uint64_t addressSpace() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return kUnlimited;
    uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const uint64_t used = pages * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
    return limit.rlim_cur - std::min<uint64_t>(used, limit.rlim_cur);
}

// What the control group of a container leaves: its limit without the memory of its processes. What it holds
// of files can be given up.
uint64_t groupMemory() {
    std::string line;
    std::getline(std::ifstream("/proc/self/cgroup"), line);
    if (!line.starts_with("0::"))
        return kUnlimited;
    const std::string folder = "/sys/fs/cgroup" + line.substr(3);
    const std::optional<uint64_t> limit = numberIn(folder + "/memory.max", ""); // or the word "max"
    if (!limit)
        return kUnlimited;
    return *limit - std::min(numberIn(folder + "/memory.stat", "anon ").value_or(0), *limit);
}

std::string textOf(uint64_t bytes) {
    constexpr double kMebibyte = 1024.0 * 1024.0;
    const double mebibytes = static_cast<double>(bytes) / kMebibyte;
    return mebibytes < 1024.0 ? fmt::format("{:.0f} MiB", mebibytes)
                              : fmt::format("{:.1f} GiB", mebibytes / 1024.0);
}

} // namespace

uint64_t availableMemory() {
    return std::min({systemMemory(), addressSpace(), groupMemory()});
}

std::string memoryShortage(uint64_t bytes) {
    constexpr uint64_t kAlways = 1u << 24; // bytes; less is not worth asking for
    if (bytes <= kAlways)
        return {};
    const uint64_t available = availableMemory();
    if (bytes <= available)
        return {};
    return fmt::format("take {} of memory, {} are available", textOf(bytes), textOf(available));
}

void keepHeapSmall() {
#ifdef __GLIBC__
    constexpr int kLarge = 1 << 20; // bytes
    mallopt(M_MMAP_THRESHOLD, kLarge);
    mallopt(M_ARENA_MAX, 2);
#endif
}

} // namespace lavalight
