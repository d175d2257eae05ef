// Based on: Ward, "Real Pixels", Graphics Gems II, 1991; the format's description in Radiance's manual,
// "filefmts".
#include "image/hdr.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"

namespace lavalight {
namespace {

using Rgbe = std::array<uint8_t, 4>;

struct Size {
    uint32_t width = 0;
    uint32_t height = 0;
    bool isFromBottom = false;
};

// Bytes and lines from the front of a file, which may end at any of them.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}

    std::string_view line() {
        const size_t end = rest_.find('\n');
        if (end == std::string_view::npos)
            throw Error("it ends within its header");
        std::string_view text = rest_.substr(0, end);
        rest_.remove_prefix(end + 1);
        if (text.ends_with('\r'))
            text.remove_suffix(1);
        return text;
    }

    uint8_t byte() {
        if (rest_.empty())
            throw Error("it ends within its pixels");
        const auto value = static_cast<uint8_t>(rest_.front());
        rest_.remove_prefix(1);
        return value;
    }

    Rgbe pixel() {
        Rgbe pixel{};
        for (uint8_t& value : pixel)
            value = byte();
        return pixel;
    }

    [[nodiscard]] size_t left() const { return rest_.size(); }

    // Takes the mark of a run-length encoded row of that width, if it is next.
    bool takesRowMark(uint32_t width) {
        if (rest_.size() < 4 || rest_[0] != 2 || rest_[1] != 2 || (rest_[2] & 0x80) != 0)
            return false;
        const uint32_t marked = static_cast<uint8_t>(rest_[2]) << 8u | static_cast<uint8_t>(rest_[3]);
        if (marked != width)
            throw Error(fmt::format("a row claims {} pixels of {}", marked, width));
        rest_.remove_prefix(4);
        return true;
    }

  private:
    std::string_view rest_;
};

template <typename Number>
Number parse(std::string_view text, const char* what) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        throw Error(fmt::format("its {} is not a number", what));
    return value;
}

std::string_view trimmed(std::string_view text) {
    while (text.starts_with(' '))
        text.remove_prefix(1);
    while (text.ends_with(' '))
        text.remove_suffix(1);
    return text;
}

// Lines of variables up to an empty one. Returns the product of all exposures, by which the scene's values
// were multiplied.
float readVariables(Reader& reader) {
    if (!reader.line().starts_with("#?"))
        throw Error("it is not a Radiance HDR file");
    float exposure = 1.0f;
    for (std::string_view line = reader.line(); !line.empty(); line = reader.line()) {
        if (line.starts_with("FORMAT=") && trimmed(line.substr(7)) != "32-bit_rle_rgbe")
            throw Error("its pixels are not RGBE");
        if (line.starts_with("EXPOSURE="))
            exposure *= parse<float>(trimmed(line.substr(9)), "exposure");
    }
    if (!(exposure > 0.0f) || !std::isfinite(exposure))
        throw Error("its exposure is not above 0");
    return exposure;
}

// The line with the size: "-Y height +X width", or +Y for rows from the bottom.
Size readSize(Reader& reader) {
    const std::string_view line = trimmed(reader.line());
    const size_t x = line.find(" +X ");
    if (!(line.starts_with("-Y ") || line.starts_with("+Y ")) || x == std::string_view::npos)
        throw Error("its rows do not run from left to right; save it with \"-Y height +X width\"");
    const auto height = parse<uint64_t>(trimmed(line.substr(3, x - 3)), "height");
    const auto width = parse<uint64_t>(trimmed(line.substr(x + 4)), "width");
    if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide)
        throw Error(
            fmt::format("it has {} x {} pixels; the limit is {} a side", width, height, kMaxImageSide));
    return {static_cast<uint32_t>(width), static_cast<uint32_t>(height), line.front() == '+'};
}

// Reads one component of a row: a count above 128 repeats the byte after it, another one precedes so many
// bytes.
void readComponent(Reader& reader, std::vector<Rgbe>& row, size_t component) {
    for (size_t x = 0; x < row.size();) {
        const uint8_t code = reader.byte();
        const bool isRun = code > 128;
        const size_t count = isRun ? code - 128u : code;
        if (count == 0 || count > row.size() - x)
            throw Error("a run leaves its row");
        const uint8_t repeated = isRun ? reader.byte() : uint8_t{0};
        for (size_t i = 0; i < count; ++i)
            row[x++][component] = isRun ? repeated : reader.byte();
    }
}

// Reads pixels one by one, with runs of the old kind: (1, 1, 1, n) repeats the pixel before it n times, and
// directly after another such mark 256 times as often.
void readPixels(Reader& reader, std::vector<Rgbe>& row) {
    unsigned shift = 0;
    for (size_t x = 0; x < row.size();) {
        const Rgbe pixel = reader.pixel();
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            row[x++] = pixel;
            shift = 0;
            continue;
        }
        const size_t count = size_t{pixel[3]} << shift;
        if (x == 0 || shift > 16 || count > row.size() - x)
            throw Error("a run leaves its row");
        for (size_t i = 0; i < count; ++i, ++x)
            row[x] = row[x - 1];
        shift += 8;
    }
}

glm::vec3 radianceOf(const Rgbe& pixel, float scale) {
    if (pixel[3] == 0)
        return glm::vec3(0.0f);
    const float unit = std::ldexp(scale, pixel[3] - (128 + 8));
    return unit * glm::vec3(pixel[0], pixel[1], pixel[2]);
}

// Fewest bytes of a row: a pixel, and marks that repeat it 255 and 256 * 255 times. The new runs take more.
uint64_t fewestBytes(uint32_t width) {
    return width == 1 ? 4 : width <= 256 ? 8 : 12;
}

Image decode(std::string_view bytes, uint64_t mostPixels) {
    Reader reader(bytes);
    const float exposure = readVariables(reader);
    const Size size = readSize(reader);
    if (reader.left() / fewestBytes(size.width) < size.height)
        throw Error("it ends within its pixels");
    requirePixelsFit(size.width, size.height, mostPixels, sizeof(glm::vec3));
    Image image(size.width, size.height);
    std::vector<Rgbe> row(size.width);
    for (uint32_t y = 0; y < size.height; ++y) {
        if (reader.takesRowMark(size.width))
            for (size_t component = 0; component < 4; ++component)
                readComponent(reader, row, component);
        else
            readPixels(reader, row);
        const uint32_t top = size.isFromBottom ? size.height - 1 - y : y;
        for (uint32_t x = 0; x < size.width; ++x)
            image.pixels[size_t{top} * size.width + x] = radianceOf(row[x], 1.0f / exposure);
    }
    return image;
}

} // namespace

Image readHdr(const std::filesystem::path& path, uint64_t mostPixels) {
    const std::string bytes = readFile(path);
    try {
        return decode(bytes, mostPixels);
    } catch (const Error& error) {
        throw Error(fmt::format("cannot read {}: {}", path.string(), error.what()));
    }
}

} // namespace lavalight
