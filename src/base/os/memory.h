// Whether memory suffices, asked before it is taken: Linux grants more than there is and then kills who uses
// it. And how it is given back.
#pragma once

#include <cstdint>
#include <string>

namespace lavalight {

// Bytes that this process may still take: what the system can give without swapping, or what the limits of
// the process and of its control group leave, whichever is least.
[[nodiscard]] uint64_t availableMemory();

// Nothing where `bytes` are available, else the end of a sentence: "take 12.0 GiB of memory, 350 MiB are
// available".
[[nodiscard]] std::string memoryShortage(uint64_t bytes);

// Keeps programs small that run for hours: from now on, blocks of 1 MiB or more (images, films, what lavapipe
// takes for buffers) go back to the system when they are freed, and all threads share two heaps. By itself
// glibc raises that limit to the size of what was freed, up to 32 MiB, and then keeps such blocks scattered
// in its heaps, eight for each processor: a window that was resized 160 times held 409 MiB, and with this
// call 234. Does nothing with another C library.
void keepHeapSmall();

} // namespace lavalight
