// Whether memory suffices, asked before it is taken: Linux grants more than there is and then kills who uses
// it.
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

} // namespace lavalight
