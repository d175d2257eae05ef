#include "render/film.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "gpu/commands.h"

namespace lavalight {
namespace {

uint32_t rowsPerBand(const gpu::Device& device, uint32_t words, glm::uvec2 size, uint32_t wanted) {
    const auto [width, height] = std::pair(size.x, size.y);
    const uint64_t bytesPerRow = uint64_t{width} * words * sizeof(uint32_t);
    const auto most = static_cast<uint32_t>(
        std::min<uint64_t>(device.limits().maxStorageBufferBytes / bytesPerRow, height));
    if (most == 0)
        throw Error(fmt::format("an image row of {} pixels does not fit into a storage buffer of {}", width,
                                device.description().name));
    return wanted == 0 ? most : std::min(wanted, most);
}

// Copies words between a band's word planes, each of `count` pixels, and the whole image's: a function of
// both.
template <typename Copy>
void forEachWord(const FilmBand& band, const RawFilm& raw, const Copy& copy) {
    const size_t count = size_t{band.rows} * raw.width;
    const size_t first = size_t{band.firstRow} * raw.width;
    for (size_t word = 0; word < raw.layout.words(); ++word)
        copy(word * count, word * raw.pixels() + first, count);
}

} // namespace

Film::Film(gpu::Device& device, uint32_t width, uint32_t height, uint32_t bandRows, FilmLayout layout)
    : device_(&device), width_(width), height_(height), layout_(std::move(layout)),
      tallies_(device, "film tallies", 2 * kTallyCount * sizeof(uint32_t), gpu::BufferUse::readback) {
    const uint32_t rows = rowsPerBand(device, layout_.words(), {width, height}, bandRows);
    for (uint32_t first = 0; first < height; first += rows) {
        const uint32_t here = std::min(rows, height - first);
        const uint64_t bytes = uint64_t{here} * width * layout_.words() * sizeof(uint32_t);
        bands_.push_back({first, here, gpu::Buffer(device, "film", bytes, gpu::BufferUse::storage)});
    }
    clear();
}

void Film::clear() {
    ids_ = emptyIds(layout_, size_t{width_} * height_);
    gpu::Commands commands(*device_);
    commands.begin();
    for (const FilmBand& band : bands_)
        commands.fill(band.sums, 0);
    commands.fill(tallies_, 0);
    commands.submitAndWait();
}

Rendering Film::resolve() const {
    return resolve(0xffffffffu);
}

Rendering Film::resolve(uint32_t rows) const {
    Rendering rendering = emptyRendering(layout_, width_, height_, rows);
    for (const FilmBand& band : bands_) {
        const size_t firstPixel = size_t{band.firstRow} * width_;
        if (const std::span<const uint32_t> words = band.sums.mapped<uint32_t>(); !words.empty())
            resolvePixels(words, layout_, firstPixel, rendering);
        else
            resolvePixels(band.sums.downloadAll<uint32_t>(), layout_, firstPixel, rendering);
    }
    return rendering;
}

FilmTallies Film::readTallies() const {
    return readable(rawTallies());
}

RawTallies Film::rawTallies() const {
    const std::vector<uint32_t> words = tallies_.downloadAll<uint32_t>();
    RawTallies tallies;
    for (size_t i = 0; i < kTallyCount; ++i)
        tallies[i] = uint64_t{words[2 * i + 1]} << 32 | words[2 * i];
    return tallies;
}

RawFilm Film::read() const {
    RawFilm raw{width_,       height_, std::vector<uint32_t>(layout_.words() * size_t{width_} * height_),
                rawTallies(), layout_, ids_};
    for (const FilmBand& band : bands_) {
        const std::vector<uint32_t> words = band.sums.downloadAll<uint32_t>();
        forEachWord(band, raw, [&](size_t ofBand, size_t ofImage, size_t count) {
            std::copy_n(words.begin() + static_cast<ptrdiff_t>(ofBand), count,
                        raw.words.begin() + static_cast<ptrdiff_t>(ofImage));
        });
    }
    return raw;
}

void Film::restore(const RawFilm& raw) {
    assert(raw.width == width_ && raw.height == height_ && raw.layout == layout_);
    for (FilmBand& band : bands_) {
        std::vector<uint32_t> words(layout_.words() * size_t{band.rows} * width_);
        forEachWord(band, raw, [&](size_t ofBand, size_t ofImage, size_t count) {
            std::copy_n(raw.words.begin() + static_cast<ptrdiff_t>(ofImage), count,
                        words.begin() + static_cast<ptrdiff_t>(ofBand));
        });
        band.sums.upload(std::span<const uint32_t>(words));
    }
    ids_ = raw.ids;
    std::vector<uint32_t> tallies;
    for (const uint64_t count : raw.tallies) {
        tallies.push_back(static_cast<uint32_t>(count));
        tallies.push_back(static_cast<uint32_t>(count >> 32));
    }
    tallies_.upload(std::span<const uint32_t>(tallies));
}

} // namespace lavalight
