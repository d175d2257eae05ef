#include "image/pixel_limit.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/os/memory.h"

namespace lavalight {

void requirePixelsFit(uint64_t width, uint64_t height, uint64_t most, uint64_t bytesEach) {
    if (width * height > most)
        throw Error(fmt::format("it has {} x {} pixels; the limit is {}, as of 16384 x {}: scale it down",
                                width, height, most, most / kMaxImageSide));
    if (const std::string shortage = memoryShortage(width * height * bytesEach); !shortage.empty())
        throw Error(fmt::format("its {} x {} pixels {}: scale it down", width, height, shortage));
}

} // namespace lavalight
