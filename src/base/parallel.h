// Loops over all processors.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace lavalight {

// Calls work(i) once for each i below `count`, on all processors, and returns when all is done. The work must
// not throw: an exception on another thread ends the program.
template <typename Work>
void forEachInParallel(std::size_t count, const Work& work) {
    std::atomic<std::size_t> next = 0;
    const auto run = [&] {
        for (std::size_t i = next++; i < count; i = next++)
            work(i);
    };
    const std::size_t processors = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> others; // this thread works too
    for (std::size_t i = 1; i < std::min(count, processors); ++i)
        others.emplace_back(run);
    run();
}

} // namespace lavalight
