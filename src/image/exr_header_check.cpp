// A walk along the attributes of all headers (OpenEXR's file layout, version 2):
//
//   magic, version and flags | name 0 type 0 size value | ... | 0    one header, or several and a last 0
//
// Numbers are of 4 bytes, little-endian.
#include "image/exr_header_check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"

namespace lavalight {
namespace {

constexpr uint32_t kSeveralParts = 0x1000; // a flag of the version
constexpr size_t kLongestName = 255;
constexpr uint64_t kChannelBytes = 16; // bytes of a channel behind its name
constexpr std::string_view kMagic{"\x76\x2f\x31\x01", 4};
constexpr int kLastCompression = 9; // DWAB; OpenEXR's enumeration ends with it up to 3.3
constexpr int kHtj2k = 11;          // 10 as well

struct FixedType {
    std::string_view name;
    uint64_t size;
};
constexpr std::array<FixedType, 24> kFixedTypes = {{{"box2i", 16},
                                                    {"box2f", 16},
                                                    {"chromaticities", 32},
                                                    {"compression", 1},
                                                    {"deepImageState", 1},
                                                    {"double", 8},
                                                    {"envmap", 1},
                                                    {"float", 4},
                                                    {"int", 4},
                                                    {"keycode", 28},
                                                    {"lineOrder", 1},
                                                    {"m33f", 36},
                                                    {"m33d", 72},
                                                    {"m44f", 64},
                                                    {"m44d", 128},
                                                    {"rational", 8},
                                                    {"tiledesc", 9},
                                                    {"timecode", 8},
                                                    {"v2i", 8},
                                                    {"v2f", 8},
                                                    {"v2d", 16},
                                                    {"v3i", 12},
                                                    {"v3f", 12},
                                                    {"v3d", 24}}};

std::optional<uint64_t> sizeOf(std::string_view type) {
    const auto found = std::find_if(kFixedTypes.begin(), kFixedTypes.end(),
                                    [&](const FixedType& fixed) { return fixed.name == type; });
    return found == kFixedTypes.end() ? std::nullopt : std::optional(found->size);
}

// Names in damaged files may hold anything.
std::string printable(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c > 0x7E; }, '?');
    return name;
}

class HeaderWalk {
  public:
    explicit HeaderWalk(const std::filesystem::path& path)
        : file_(path, std::ios::binary), end_(std::filesystem::file_size(path)) {}

    void run() {
        for (const char c : kMagic)
            if (byte() != c)
                throw Error("it is not an OpenEXR file");
        const bool hasSeveral = (number() & kSeveralParts) != 0;
        bool isEmpty = header();
        while (hasSeveral && !isEmpty)
            isEmpty = header();
    }

  private:
    // Walks a header and returns whether it has no attributes.
    bool header() {
        bool isEmpty = true;
        for (std::string name = word(); !name.empty(); name = word()) {
            attribute(name);
            isEmpty = false;
        }
        return isEmpty;
    }

    void attribute(const std::string& name) {
        const std::string type = word();
        const uint64_t size = number();
        const uint64_t start = at_;
        if (type == "compression" && size == 1)
            return requireKnownCompression(static_cast<uint8_t>(byte()));
        if (size > end_ - at_)
            throw Error(fmt::format("its attribute {} claims {} bytes, the file has {}", printable(name),
                                    size, end_));
        value(type, size);
        if (at_ != start + size)
            throw Error(fmt::format("its attribute {} of type {} has {} bytes, by its value {}",
                                    printable(name), printable(type), size, at_ - start));
    }

    static void requireKnownCompression(int method) {
        if (method > kLastCompression)
            throw Error(
                fmt::format("its compression, number {}{}, is not supported; save it with ZIP, PIZ or "
                            "another of OpenEXR 3.1",
                            method, method <= kHtj2k ? " (HTJ2K)" : ""));
    }

    // Goes on to where the value ends by its type.
    void value(std::string_view type, uint64_t size) {
        if (type == "chlist") {
            while (!word().empty())
                skip(kChannelBytes);
        } else if (type == "stringvector") {
            for (const uint64_t end = at_ + size; at_ < end;)
                skip(number());
        } else if (type == "preview") {
            const uint64_t width = number();
            skip(4 * width * number());
        } else {
            skip(sizeOf(type).value_or(size));
        }
    }

    std::string word() {
        std::string text;
        for (char c = byte(); c != 0; c = byte()) {
            text += c;
            if (text.size() > kLongestName)
                throw Error("a name in its header is too long");
        }
        return text;
    }

    char byte() {
        const int c = file_.get();
        if (c == std::ifstream::traits_type::eof())
            throw Error("it ends within its header");
        ++at_;
        return static_cast<char>(c);
    }

    uint32_t number() {
        uint32_t value = 0;
        for (unsigned shift = 0; shift < 32; shift += 8)
            value |= uint32_t{static_cast<uint8_t>(byte())} << shift;
        return value;
    }

    void skip(uint64_t bytes) {
        if (bytes > end_ - at_)
            throw Error("it ends within its header");
        at_ += bytes;
        file_.seekg(static_cast<std::streamoff>(at_));
    }

    std::ifstream file_;
    uint64_t end_;    // bytes of the file
    uint64_t at_ = 0; // bytes from its start
};

} // namespace

void requireSaneAttributes(const std::filesystem::path& path) {
    HeaderWalk(path).run();
}

} // namespace lavalight
