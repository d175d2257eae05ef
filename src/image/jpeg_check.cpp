// A walk along the segments of a JPEG (ITU-T T.81, annex B):
//
//   FF D8 | FF marker length ... | FF DA length ... entropy-coded data | FF marker length ... | FF D9
//
// It visits whatever the decoder could take for a segment: bytes between segments are skipped by both.
#include "image/jpeg_check.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {
namespace {

constexpr uint8_t kFirstFrame = 0xC0;
constexpr uint8_t kProgressiveFrame = 0xC2;
constexpr uint8_t kHuffmanTables = 0xC4;
constexpr uint8_t kFirstRestart = 0xD0;
constexpr uint8_t kLastRestart = 0xD7;
constexpr uint8_t kEnd = 0xD9;
constexpr uint8_t kScan = 0xDA;
constexpr uint8_t kQuantisationTables = 0xDB;
constexpr uint8_t kRestartInterval = 0xDD;
constexpr size_t kLengths = 16; // code lengths of 1 to 16 bits: how many codes have each
constexpr size_t kMostCodes = 256;
constexpr uint32_t kBlock = 8; // texels a side

struct Component {
    uint8_t id = 0;
    uint32_t across = 1; // blocks of an interleaved unit
    uint32_t down = 1;
    uint8_t quantisation = 0; // number of its table
    bool isBegun = false;     // a scan has set its coefficients
};

struct Frame {
    bool isProgressive = false;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<Component> components;
};

uint32_t divideUp(uint32_t a, uint32_t b) {
    return (a + b - 1) / b;
}

// Whether a segment follows the marker: not after zeros stuffed into entropy-coded data, and not after
// restarts.
bool hasLength(uint8_t marker) {
    return marker != 0x00 && marker != 0x01 && (marker < kFirstRestart || marker > kEnd);
}

void require(bool condition, std::string_view problem) {
    if (!condition)
        throw Error(fmt::format("it is damaged: {}", problem));
}

class JpegWalk {
  public:
    explicit JpegWalk(std::string_view bytes) : bytes_(bytes) {}

    void run() {
        for (size_t at = 0; at + 1 < bytes_.size();) {
            const uint8_t marker = byteAt(at + 1);
            if (byteAt(at) != 0xFF || marker == 0xFF) {
                ++at;
            } else if (marker == kEnd) {
                break;
            } else if (!hasLength(marker)) {
                at += 2;
            } else {
                segment(marker, at + 2);
                at += 2 + std::max<size_t>(lengthAt(at + 2), 2);
            }
        }
        for (const Component& component : frame_.components)
            require(component.isBegun, "a component has no scan");
    }

  private:
    // Beyond the end, zeros, as the decoder has it.
    [[nodiscard]] uint8_t byteAt(size_t at) const {
        return at < bytes_.size() ? static_cast<uint8_t>(bytes_[at]) : uint8_t{0};
    }
    [[nodiscard]] uint32_t wordAt(size_t at) const { return uint32_t{byteAt(at)} << 8u | byteAt(at + 1); }

    // Of the segment whose length stands at `at`, the length's own two bytes included.
    [[nodiscard]] size_t lengthAt(size_t at) const { return wordAt(at); }

    void segment(uint8_t marker, size_t at) {
        if (marker == kHuffmanTables)
            huffmanTables(at);
        else if (marker == kQuantisationTables)
            quantisationTables(at);
        else if (marker == kRestartInterval)
            restartInterval_ = wordAt(at + 2);
        else if (marker == kScan)
            scan(at);
        else if (marker >= kFirstFrame && marker <= kProgressiveFrame && frame_.components.empty())
            frame(marker, at);
    }

    // Class and number, the counts of codes, then a byte for each code.
    void huffmanTables(size_t at) {
        const size_t end = at + lengthAt(at);
        for (at += 2; at < end;) {
            size_t codes = 0;
            for (size_t i = 0; i < kLengths; ++i)
                codes += byteAt(at + 1 + i);
            if (codes > kMostCodes)
                throw Error(fmt::format("it is damaged: a Huffman table of {} codes, at most {} are possible",
                                        codes, kMostCodes));
            const uint8_t table = byteAt(at);
            (table >> 4 == 0 ? dcTables_ : acTables_).at(table & 15u) = true;
            at += 1 + kLengths + codes;
        }
    }

    // Precision and number, then 64 values of one or two bytes.
    void quantisationTables(size_t at) {
        const size_t end = at + lengthAt(at);
        for (at += 2; at < end;) {
            const uint8_t table = byteAt(at);
            quantisationTables_.at(table & 15u) = true;
            at += table >> 4 == 0 ? 65 : 129;
        }
    }

    // Length, precision, height, width, and of each component its number, its sampling and its table.
    void frame(uint8_t marker, size_t at) {
        frame_.isProgressive = marker == kProgressiveFrame;
        frame_.height = wordAt(at + 3);
        frame_.width = wordAt(at + 5);
        for (size_t i = 0; i < byteAt(at + 7); ++i) {
            const size_t from = at + 8 + 3 * i;
            const uint8_t sampling = byteAt(from + 1);
            frame_.components.push_back({byteAt(from), std::max<uint32_t>(sampling >> 4, 1),
                                         std::max<uint32_t>(sampling & 15u, 1), byteAt(from + 2)});
        }
    }

    // Length, components with their tables, first and last coefficient, bits before and now.
    void scan(size_t at) {
        const size_t count = byteAt(at + 2);
        const size_t spectrum = at + 3 + 2 * count;
        const bool isFirst = byteAt(spectrum) == 0 && byteAt(spectrum + 2) >> 4 == 0;
        const bool usesDc = !frame_.isProgressive || isFirst;
        const bool usesAc = !frame_.isProgressive || byteAt(spectrum) != 0;
        const Component* only = nullptr;
        for (size_t i = 0; i < count; ++i) {
            Component* component = componentOf(byteAt(at + 3 + 2 * i));
            if (component == nullptr)
                continue; // an error of the decoder's
            const uint8_t tables = byteAt(at + 4 + 2 * i);
            require((!usesDc || dcTables_.at(tables >> 4)) && (!usesAc || acTables_.at(tables & 15u)),
                    "a scan uses a Huffman table that is not there");
            require(quantisationTables_.at(component->quantisation & 15u),
                    "a component uses a quantisation table that is not there");
            component->isBegun = component->isBegun || usesDc;
            require(component->isBegun, "a scan refines what no scan has begun");
            only = count == 1 ? component : nullptr;
        }
        require(restartInterval_ == 0 ||
                    restartsAfter(at + lengthAt(at)) >= (unitsOf(only) - 1) / restartInterval_,
                "a scan ends before its last restart");
    }

    Component* componentOf(uint8_t id) {
        const auto found = std::find_if(frame_.components.begin(), frame_.components.end(),
                                        [id](const Component& component) { return component.id == id; });
        return found == frame_.components.end() ? nullptr : &*found;
    }

    // What restarts are counted in: interleaved units, or blocks of the only component of a scan.
    [[nodiscard]] uint64_t unitsOf(const Component* only) const {
        uint32_t across = 1;
        uint32_t down = 1;
        for (const Component& component : frame_.components) {
            across = std::max(across, component.across);
            down = std::max(down, component.down);
        }
        uint32_t columns = divideUp(frame_.width, kBlock * across);
        uint32_t rows = divideUp(frame_.height, kBlock * down);
        if (only != nullptr) {
            columns = divideUp(divideUp(frame_.width * only->across, across), kBlock);
            rows = divideUp(divideUp(frame_.height * only->down, down), kBlock);
        }
        return std::max<uint64_t>(uint64_t{columns} * rows, 1);
    }

    // Restart markers in the entropy-coded data that begins at `at`.
    [[nodiscard]] uint64_t restartsAfter(size_t at) const {
        uint64_t restarts = 0;
        for (; at + 1 < bytes_.size(); ++at) {
            const uint8_t marker = byteAt(at + 1);
            if (byteAt(at) != 0xFF || marker == 0x00 || marker == 0xFF)
                continue;
            if (marker < kFirstRestart || marker > kLastRestart)
                break;
            ++restarts;
        }
        return restarts;
    }

    std::string_view bytes_;
    Frame frame_;
    std::array<bool, 16> dcTables_{}; // defined so far, by number
    std::array<bool, 16> acTables_{};
    std::array<bool, 16> quantisationTables_{};
    uint32_t restartInterval_ = 0; // units; 0: none
};

} // namespace

void requireSoundJpeg(std::string_view bytes) {
    JpegWalk(bytes).run();
}

} // namespace lavalight
