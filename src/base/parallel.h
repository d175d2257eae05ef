// Loops over all processors.
#pragma once

#include <cstddef>
#include <functional>

namespace lavalight {

// Calls work(i) once for each i below `count`, on all processors, and returns when all is done. An exception
// of the work ends the loop early and is thrown here. The threads stay for the next loop; a loop that starts
// while another one has them, within its work or on another thread, runs on the calling thread alone.
void forEachInParallel(std::size_t count, const std::function<void(std::size_t)>& work);

} // namespace lavalight
