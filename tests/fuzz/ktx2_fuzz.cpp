// Fuzzes KTX 2.0: the container, plain texels, and the transcoder of Basis Universal.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "image/ktx2.h"
#include "image/ktx2_container.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    constexpr int kNotKept = -1; // in the corpus
    constexpr uint64_t kMostBytes = 1u << 16u;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (!lavalight::isKtx2(bytes))
        return kNotKept;
    try {
        if (lavalight::measureKtx2(bytes).bytes() > kMostBytes)
            return kNotKept;
        const lavalight::Picture first = lavalight::decodeKtx2(bytes);
        const lavalight::Picture second = lavalight::decodeKtx2(bytes);
        if (first.bytes != second.bytes) // what no decoder set would be what was in memory before
            std::abort();
    } catch (const lavalight::Error&) {
        return 0;
    }
    return 0;
}
