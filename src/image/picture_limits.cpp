#include "image/picture_limits.h"

#include <fmt/format.h>

#include "base/error.h"
#include "image/pixel_limit.h"

namespace lavalight {

void requirePictureFits(int64_t width, int64_t height) {
    if (width < 1 || height < 1)
        throw Error("it has no texels");
    if (static_cast<uint64_t>(width) > kMostTexels / static_cast<uint64_t>(height))
        throw Error(fmt::format("it has {} x {} texels, at most {} are supported: scale it down", width,
                                height, kMostTexels));
}

void requirePlausible(int64_t width, int64_t height, size_t bytes, uint64_t mostTexelsPerByte) {
    if (static_cast<uint64_t>(width * height) / mostTexelsPerByte > bytes)
        throw Error(fmt::format("it is damaged: {} x {} texels cannot be in {} bytes", width, height, bytes));
}

} // namespace lavalight
