// A walk along the segments of a JPEG (ITU-T T.81, annex B):
//
//   FF D8 | FF marker length ... | FF DA length ... entropy-coded data | FF marker length ... | FF D9
//
// It visits whatever the decoder could take for a segment: bytes between segments are skipped by both.
#include "image/jpeg_check.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {
namespace {

constexpr uint8_t kHuffmanTables = 0xC4;
constexpr uint8_t kEnd = 0xD9;
constexpr size_t kLengths = 16; // code lengths of 1 to 16 bits: how many codes have each
constexpr size_t kMostCodes = 256;

// Beyond the end, zeros, as the decoder has it.
uint8_t byteAt(std::string_view bytes, size_t at) {
    return at < bytes.size() ? static_cast<uint8_t>(bytes[at]) : uint8_t{0};
}

// Of the segment whose length stands at `at`, the length's own two bytes included.
size_t lengthAt(std::string_view bytes, size_t at) {
    return size_t{byteAt(bytes, at)} << 8u | byteAt(bytes, at + 1);
}

// Whether a segment follows the marker: not after fill bytes, zeros stuffed into entropy-coded data,
// restarts.
bool hasLength(uint8_t marker) {
    return marker != 0x00 && marker != 0x01 && marker != 0xFF && (marker < 0xD0 || marker > kEnd);
}

// The tables of one segment: class and number, the counts of codes, then a byte for each code.
void checkTables(std::string_view bytes, size_t at) {
    const size_t end = at + lengthAt(bytes, at);
    for (at += 2; at < end;) {
        size_t codes = 0;
        for (size_t i = 0; i < kLengths; ++i)
            codes += byteAt(bytes, at + 1 + i);
        if (codes > kMostCodes)
            throw Error(fmt::format("it is damaged: a Huffman table of {} codes, at most {} are possible",
                                    codes, kMostCodes));
        at += 1 + kLengths + codes;
    }
}

} // namespace

void requireSoundJpeg(std::string_view bytes) {
    for (size_t at = 0; at + 1 < bytes.size();) {
        const uint8_t marker = byteAt(bytes, at + 1);
        if (byteAt(bytes, at) != 0xFF || marker == 0xFF) {
            ++at;
        } else if (!hasLength(marker)) {
            if (marker == kEnd)
                return;
            at += 2;
        } else {
            if (marker == kHuffmanTables)
                checkTables(bytes, at + 2);
            at += 2 + std::max<size_t>(lengthAt(bytes, at + 2), 2);
        }
    }
}

} // namespace lavalight
