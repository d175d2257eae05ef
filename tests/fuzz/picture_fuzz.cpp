// Fuzzes the decoding of pictures: PNG, JPEG and WebP.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "image/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    try {
        const lavalight::Picture picture =
            lavalight::decodePicture({reinterpret_cast<const char*>(data), size});
        const size_t texelSize = picture.is16Bit ? 8 : 4;
        if (picture.bytes.size() != size_t{picture.width} * picture.height * texelSize)
            std::abort();
    } catch (const lavalight::Error&) {
        return 0;
    }
    return 0;
}
