// Loops over all processors.
#pragma once

#include <cstddef>
#include <functional>

namespace lavalight {

// Lets loops from now on use at most so many threads, the calling one among them; 0: as many as there are
// processors. To be said before the first loop, which starts them; later only 1 has an effect.
void limitThreads(unsigned threads);
// What was said last; 0: nothing.
[[nodiscard]] unsigned threadLimit();

// Calls work(i) once for each i below `count`, on all processors, and returns when all is done. An exception
// of the work ends the loop early and is thrown here. The threads stay for the next loop. Loops may run at
// the same time, on several threads or one within the other: threads without work help the oldest that has
// some.
void forEachInParallel(std::size_t count, const std::function<void(std::size_t)>& work);

} // namespace lavalight
