// Based on: Ward, "Real Pixels", Graphics Gems II, 1991; the format's description in Radiance's manual,
// "filefmts".
#include "image/hdr.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/parse.h"

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
    const std::optional<Number> value = parseNumber<Number>(text);
    if (!value)
        throw Error(fmt::format("its {} is not a number", what));
    return *value;
}

bool isBlank(char c) {
    return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isBlank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back()))
        text.remove_suffix(1);
    return text;
}

// Takes a number off the front of `text` as C's atof reads it, with blanks and a plus sign before it.
double takeFactor(std::string_view& text, const char* what) {
    text = trimmed(text);
    if (text.starts_with('+') && !text.starts_with("+-"))
        text.remove_prefix(1);
    const std::optional<double> value = takeNumber<double>(text);
    if (!value || !(text.empty() || isBlank(text.front())))
        throw Error(fmt::format("its {} is not a number", what));
    if (!(*value > 0.0) || !std::isfinite(*value))
        throw Error(fmt::format("its {} is not above 0", what));
    return *value;
}

// Lines of variables up to an empty one. Returns what the scene's values were multiplied by: the product of
// all exposures and, by channel, of all colour corrections.
glm::dvec3 readVariables(Reader& reader) {
    if (!reader.line().starts_with("#?"))
        throw Error("it is not a Radiance HDR file");
    glm::dvec3 factors(1.0);
    for (std::string_view line = reader.line(); !line.empty(); line = reader.line()) {
        const std::string_view name = line.substr(0, line.find('=') + 1);
        std::string_view value = line.substr(name.size());
        if (name == "FORMAT=" && trimmed(value) != "32-bit_rle_rgbe")
            throw Error("its pixels are not RGBE");
        if (name == "EXPOSURE=")
            factors *= takeFactor(value, "exposure");
        if (name == "COLORCORR=")
            for (glm::length_t c = 0; c < 3; ++c)
                factors[c] *= takeFactor(value, "colour correction");
    }
    const glm::vec3 scale = 1.0f / glm::vec3(factors);
    if (!glm::all(glm::lessThan(scale, glm::vec3(std::numeric_limits<float>::infinity()))) ||
        !glm::all(glm::greaterThan(scale, glm::vec3(0.0f))))
        throw Error("its exposure is out of range");
    return factors;
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

glm::vec3 radianceOf(const Rgbe& pixel, const glm::vec3& scale) {
    if (pixel[3] == 0)
        return glm::vec3(0.0f);
    const int exponent = pixel[3] - (128 + 8);
    const glm::vec3 unit(std::ldexp(scale.x, exponent), std::ldexp(scale.y, exponent),
                         std::ldexp(scale.z, exponent));
    return unit * glm::vec3(pixel[0], pixel[1], pixel[2]);
}

// Fewest bytes of a row: a pixel, and marks that repeat it 255 and 256 * 255 times. The new runs take more.
uint64_t fewestBytes(uint32_t width) {
    return width == 1 ? 4 : width <= 256 ? 8 : 12;
}

Image decode(std::string_view bytes, uint64_t mostPixels) {
    Reader reader(bytes);
    const glm::vec3 scale = 1.0f / glm::vec3(readVariables(reader));
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
            image.pixels[size_t{top} * size.width + x] = radianceOf(row[x], scale);
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
