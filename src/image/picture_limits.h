// What a picture's header may ask for.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lavalight {

// Throws Error for a picture without texels, and for one of more than kMostTexels.
void requirePictureFits(int64_t width, int64_t height);

// Throws Error where so many bytes cannot hold so many texels: a small file of a huge picture is damaged, or
// made to fill the memory.
void requirePlausible(int64_t width, int64_t height, size_t bytes, uint64_t mostTexelsPerByte);

} // namespace lavalight
