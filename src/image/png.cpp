// Portable Network Graphics (PNG) Specification, third edition, W3C 2025.
#include "image/png.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <new>
#include <string_view>

#include <fmt/format.h>
#include <zlib.h>

#include "base/error.h"
#include "base/file.h"
#include "image/image.h"

namespace lavalight {
namespace {

// Of a picture of 512x512, zlib's level 4 takes 14 ms for 344 kB, level 6 52 ms for 330 kB, and level 1 8 ms
// for 366 kB.
constexpr int kLevel = 4;

constexpr size_t kChunkBytes = 1u << 20; // of compressed data, at most

std::string bigEndian(uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes.push_back(static_cast<char>(value >> shift & 0xffu));
    return bytes;
}

const Bytef* bytesOf(std::string_view text) {
    return reinterpret_cast<const Bytef*>(text.data());
}

// Length, type, data, and the checksum of the latter two (section 5.3).
void appendChunk(std::string& file, std::string_view type, std::string_view data) {
    file += bigEndian(static_cast<uint32_t>(data.size()));
    file += type;
    file += data;
    const uLong ofType = crc32(0, bytesOf(type), static_cast<uInt>(type.size()));
    // crc32() gives its initial value for a null pointer, which empty data may have.
    file += bigEndian(static_cast<uint32_t>(
        data.empty() ? ofType : crc32(ofType, bytesOf(data), static_cast<uInt>(data.size()))));
}

// What foretells a byte from those to its left, above it and to the left of that one (section 9.2).
enum class RowFilter : uint8_t { none, left, above, average, paeth };
constexpr size_t kRowFilters = 5;

int foretold(RowFilter filter, int left, int above, int aboveLeft) {
    switch (filter) {
    case RowFilter::none:
        return 0;
    case RowFilter::left:
        return left;
    case RowFilter::above:
        return above;
    case RowFilter::average:
        return (left + above) / 2;
    case RowFilter::paeth:
        break;
    }
    const int guess = left + above - aboveLeft;
    const int toLeft = std::abs(guess - left);
    const int toAbove = std::abs(guess - above);
    const int toAboveLeft = std::abs(guess - aboveLeft);
    if (toLeft <= toAbove && toLeft <= toAboveLeft)
        return left;
    return toAbove <= toAboveLeft ? above : aboveLeft;
}

// Rows of a picture, each as the filter's number and what it leaves of the bytes.
class FilteredRows {
  public:
    FilteredRows(uint32_t width, int channels)
        : channels_(static_cast<size_t>(channels)), row_(width * channels_), above_(row_.size()) {
        candidates_.fill(std::vector<uint8_t>(row_.size() + 1));
    }

    // The next row, as the filter leaves it whose bytes are the smallest in sum, taken as signed ones: the
    // heuristic of section 12.7.
    const std::vector<uint8_t>& filter(std::span<const uint32_t> pixels) {
        std::swap(row_, above_);
        for (size_t i = 0; i < pixels.size(); ++i)
            for (size_t channel = 0; channel < channels_; ++channel)
                row_[i * channels_ + channel] = static_cast<uint8_t>(pixels[i] >> (8 * channel));
        const std::array<uint64_t, kRowFilters> sums = {
            filterBy<RowFilter::none>(), filterBy<RowFilter::left>(), filterBy<RowFilter::above>(),
            filterBy<RowFilter::average>(), filterBy<RowFilter::paeth>()};
        return candidates_[static_cast<size_t>(std::ranges::min_element(sums) - sums.begin())];
    }

  private:
    template <RowFilter filter>
    uint64_t filterBy() {
        std::vector<uint8_t>& filtered = candidates_[static_cast<size_t>(filter)];
        filtered[0] = static_cast<uint8_t>(filter);
        uint64_t sum = 0;
        const auto keep = [&](size_t i, int left, int aboveLeft) {
            filtered[i + 1] = static_cast<uint8_t>(row_[i] - foretold(filter, left, above_[i], aboveLeft));
            sum += static_cast<uint64_t>(std::abs(static_cast<int8_t>(filtered[i + 1])));
        };
        for (size_t i = 0; i < channels_; ++i) // nothing lies to the left
            keep(i, 0, 0);
        for (size_t i = channels_; i < row_.size(); ++i)
            keep(i, row_[i - channels_], above_[i - channels_]);
        return sum;
    }

    size_t channels_;
    std::vector<uint8_t> row_;
    std::vector<uint8_t> above_; // zeros above the first
    std::array<std::vector<uint8_t>, kRowFilters> candidates_;
};

// Appends chunks IDAT with what it compresses.
class Compressor {
  public:
    explicit Compressor(std::string& file) : file_(file), chunk_(kChunkBytes, '\0') {
        if (deflateInit(&stream_, kLevel) != Z_OK)
            throw std::bad_alloc();
        clearChunk();
    }
    ~Compressor() { deflateEnd(&stream_); }
    Compressor(const Compressor&) = delete;
    Compressor& operator=(const Compressor&) = delete;

    void add(std::span<const uint8_t> bytes) {
        stream_.next_in = const_cast<Bytef*>(bytes.data()); // zlib does not change it
        stream_.avail_in = static_cast<uInt>(bytes.size());
        while (stream_.avail_in > 0) {
            deflate(&stream_, Z_NO_FLUSH);
            if (stream_.avail_out == 0)
                writeChunk();
        }
    }
    void finish() {
        while (deflate(&stream_, Z_FINISH) != Z_STREAM_END)
            writeChunk();
        writeChunk();
    }

  private:
    void clearChunk() {
        stream_.next_out = reinterpret_cast<Bytef*>(chunk_.data());
        stream_.avail_out = static_cast<uInt>(chunk_.size());
    }
    void writeChunk() {
        appendChunk(file_, "IDAT", std::string_view(chunk_).substr(0, chunk_.size() - stream_.avail_out));
        clearChunk();
    }

    std::string& file_;
    std::string chunk_;
    z_stream stream_{};
};

std::string encode(uint32_t width, uint32_t height, std::span<const uint32_t> pixels, const PngTexts& texts) {
    const bool isOpaque = std::ranges::all_of(pixels, [](uint32_t pixel) { return pixel >> 24 == 0xffu; });
    std::string file = "\x89PNG\r\n\x1a\n";
    // Bits of a sample, colours with or without alpha, and the only methods that there are.
    const std::array<char, 5> form = {8, isOpaque ? char{2} : char{6}, 0, 0, 0};
    appendChunk(file, "IHDR", bigEndian(width) + bigEndian(height) + std::string(form.begin(), form.end()));
    for (const auto& [keyword, text] : texts)
        appendChunk(file, "tEXt", keyword + '\0' + text);
    FilteredRows rows(width, isOpaque ? 3 : 4);
    Compressor compressor(file);
    for (size_t y = 0; y < height; ++y)
        compressor.add(rows.filter(pixels.subspan(y * width, width)));
    compressor.finish();
    appendChunk(file, "IEND", {});
    return file;
}

} // namespace

std::string encodePng(uint32_t width, uint32_t height, std::span<const uint32_t> pixels,
                      const PngTexts& texts) {
    assert(width > 0 && height > 0 && width <= kMaxImageSide && height <= kMaxImageSide);
    assert(pixels.size() == size_t{width} * height);
    try {
        return encode(width, height, pixels, texts);
    } catch (const std::bad_alloc&) {
        throw Error(fmt::format("{} x {} pixels do not fit into memory", width, height));
    }
}

void writePng(const std::filesystem::path& path, uint32_t width, uint32_t height,
              std::span<const uint32_t> pixels, const PngTexts& texts) {
    writeFileAtomically(path, encodePng(width, height, pixels, texts));
}

} // namespace lavalight
