#include "film/film_bytes.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/byte_stream.h"
#include "base/error.h"
#include "image/pixel_limit.h"

namespace lavalight {
namespace {

constexpr std::string_view kMark = "lavalight film 1\n";
constexpr uint64_t kMostPlanes = 1u << 20;

void writePlane(std::span<const uint32_t> plane, ByteWriter& writer) {
    const bool isAlike =
        std::all_of(plane.begin(), plane.end(), [&](uint32_t word) { return word == plane.front(); });
    writer.array(isAlike ? plane.first(1) : plane);
}

void readPlane(ByteReader& reader, size_t pixels, std::vector<uint32_t>& values) {
    const auto plane = reader.array<uint32_t>();
    if (plane.size() == 1)
        values.insert(values.end(), pixels, plane.front());
    else if (plane.size() == pixels)
        values.insert(values.end(), plane.begin(), plane.end());
    else
        throw Error("one of its planes has another number of pixels");
}

UintImage readStored(ByteReader& reader) {
    UintImage stored;
    const uint64_t width = reader.number();
    const uint64_t height = reader.number();
    if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide)
        throw Error("it does not say how large its image is");
    stored.width = static_cast<uint32_t>(width);
    stored.height = static_cast<uint32_t>(height);
    for (uint64_t left = reader.number(); left > 0; --left) {
        std::string key = reader.text();
        stored.metadata.emplace_back(std::move(key), reader.text());
    }
    const uint64_t planes = reader.number();
    if (planes > kMostPlanes)
        throw Error("it has more planes than films have");
    const size_t pixels = size_t{stored.width} * stored.height;
    requirePixelsFit(stored.width, stored.height, kMaxImagePixels, sizeof(uint32_t) * planes);
    stored.values.reserve(pixels * planes);
    for (uint64_t plane = 0; plane < planes; ++plane)
        readPlane(reader, pixels, stored.values);
    reader.requireEnd();
    return stored;
}

} // namespace

std::string filmBytes(const FilmFile& file) {
    const UintImage stored = storedFilm(file);
    const size_t pixels = file.film.pixels();
    ByteWriter writer(kMark);
    writer.number(stored.width);
    writer.number(stored.height);
    writer.number(stored.metadata.size());
    for (const auto& [key, value] : stored.metadata) {
        writer.text(key);
        writer.text(value);
    }
    writer.number(stored.values.size() / pixels);
    for (size_t first = 0; first < stored.values.size(); first += pixels)
        writePlane(std::span(stored.values).subspan(first, pixels), writer);
    return writer.take();
}

FilmFile filmFromBytes(std::string_view bytes, const std::string& name) {
    try {
        ByteReader reader(bytes, kMark);
        return filmOf(readStored(reader));
    } catch (const Error& error) {
        throw Error(fmt::format("cannot read {}: {}", name, error.what()));
    }
}

} // namespace lavalight
