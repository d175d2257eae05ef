// Fuzzes the decoding of pictures: PNG, JPEG, WebP and KTX2. What is decoded twice is the same twice: pixels
// that no decoder set would be what was in memory before.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "image/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    constexpr uint64_t kMostBytes = 1u << 18u; // larger ones take long and show nothing new
    try {
        if (lavalight::measurePicture(bytes).bytes() > kMostBytes)
            return 0;
        const lavalight::Picture first = lavalight::decodePicture(bytes);
        const lavalight::Picture second = lavalight::decodePicture(bytes);
        const size_t texelSize = first.is16Bit ? 8 : 4;
        if (first.bytes.size() != size_t{first.width} * first.height * texelSize ||
            first.bytes != second.bytes)
            std::abort();
    } catch (const lavalight::Error&) {
        return 0;
    }
    return 0;
}
