#include "python/image_record.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/byte_stream.h"
#include "base/error.h"
#include "film/film_bytes.h"
#include "image/pixel_limit.h"

namespace lavalight::python {
namespace {

constexpr std::string_view kMark = "lavalight image 1\n";

void write(const Image& image, ByteWriter& writer) {
    writer.array(std::span<const glm::vec3>(image.pixels));
}

Image readImage(uint32_t width, uint32_t height, ByteReader& reader) {
    Image image;
    image.width = width;
    image.height = height;
    image.pixels = reader.array<glm::vec3>();
    if (image.pixels.size() != size_t{width} * height)
        throw Error("a layer has another number of pixels");
    return image;
}

void write(const Rendering& rendering, ByteWriter& writer) {
    writer.number(rendering.radiance().width);
    writer.number(rendering.radiance().height);
    writer.number(rendering.layers.size());
    for (const Layer& layer : rendering.layers) {
        writer.text(layer.name);
        writer.number(layer.channels.size());
        for (const std::string& channel : layer.channels)
            writer.text(channel);
        write(layer.mean, writer);
        writer.number(layer.variance ? 1 : 0);
        if (layer.variance)
            write(*layer.variance, writer);
    }
    writer.array(std::span<const uint32_t>(rendering.sampleCounts));
    writer.number(rendering.place ? 1 : 0);
    if (rendering.place)
        writer.array(std::span(&*rendering.place, 1));
}

Rendering readRendering(ByteReader& reader) {
    Rendering rendering;
    const auto width = static_cast<uint32_t>(reader.number());
    const auto height = static_cast<uint32_t>(reader.number());
    if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide)
        throw Error("it does not say how large it is");
    for (uint64_t left = reader.number(); left > 0; --left) {
        Layer layer;
        layer.name = reader.text();
        for (uint64_t channels = reader.number(); channels > 0; --channels)
            layer.channels.push_back(reader.text());
        layer.mean = readImage(width, height, reader);
        if (reader.number() != 0)
            layer.variance = readImage(width, height, reader);
        rendering.layers.push_back(std::move(layer));
    }
    rendering.sampleCounts = reader.array<uint32_t>();
    if (rendering.layers.empty() || rendering.sampleCounts.size() != size_t{width} * height)
        throw Error("its layers are not those of an image");
    if (reader.number() != 0) {
        const auto places = reader.array<ImagePlace>();
        if (places.size() != 1)
            throw Error("it does not say which part of an image it is");
        rendering.place = places.front();
    }
    return rendering;
}

void write(const Metadata& metadata, ByteWriter& writer) {
    writer.number(metadata.size());
    for (const auto& [key, value] : metadata) {
        writer.text(key);
        writer.text(value);
    }
}

Metadata readMetadata(ByteReader& reader) {
    Metadata metadata;
    for (uint64_t left = reader.number(); left > 0; --left) {
        std::string key = reader.text();
        metadata.emplace_back(std::move(key), reader.text());
    }
    return metadata;
}

template <typename Value>
void write(const std::vector<OwnedChannel<Value>>& channels, ByteWriter& writer) {
    writer.number(channels.size());
    for (const OwnedChannel<Value>& channel : channels) {
        writer.text(channel.name);
        writer.array(std::span<const Value>(channel.values));
    }
}

template <typename Value>
std::vector<OwnedChannel<Value>> readChannels(size_t pixels, ByteReader& reader) {
    std::vector<OwnedChannel<Value>> channels;
    for (uint64_t left = reader.number(); left > 0; --left) {
        std::string name = reader.text();
        channels.push_back({std::move(name), reader.array<Value>()});
        if (channels.back().values.size() != pixels)
            throw Error("a channel has another number of pixels");
    }
    return channels;
}

void write(const ToneSettings& tone, ByteWriter& writer) {
    writer.number(static_cast<uint64_t>(tone.curve));
    writer.array(std::span(&tone.exposure, 1));
    writer.array(tone.backdrop ? std::span(&*tone.backdrop, 1) : std::span<const glm::vec3>());
}

ToneSettings readTone(ByteReader& reader) {
    ToneSettings tone;
    const uint64_t curve = reader.number();
    const auto exposures = reader.array<float>();
    const auto backdrops = reader.array<glm::vec3>();
    if (curve > static_cast<uint64_t>(ToneCurve::aces) || exposures.size() != 1 || backdrops.size() > 1)
        throw Error("its tone curve is not one");
    tone.curve = static_cast<ToneCurve>(curve);
    tone.exposure = exposures.front();
    if (!backdrops.empty())
        tone.backdrop = backdrops.front();
    return tone;
}

} // namespace

std::string imageBytes(const ImageRecord& record) {
    const FinishedImage& image = record.image;
    ByteWriter writer(kMark);
    write(image.rendering, writer);
    write(image.ids.uints, writer);
    write(image.ids.floats, writer);
    write(image.ids.attributes, writer);
    writer.text(image.film ? filmBytes(*image.film) : std::string());
    writer.number(image.holdsFilm ? 1 : 0);
    writer.number(image.tone ? 1 : 0);
    if (image.tone)
        write(*image.tone, writer);
    writer.array(std::span<const uint32_t>(image.pixels));
    write(record.header, writer);
    writer.text(record.report);
    writer.number(record.isComplete ? 1 : 0);
    return writer.take();
}

ImageRecord imageFromBytes(std::string_view bytes) {
    try {
        ByteReader reader(bytes, kMark);
        ImageRecord record;
        FinishedImage& image = record.image;
        image.rendering = readRendering(reader);
        const size_t pixels = image.rendering.sampleCounts.size();
        image.ids.uints = readChannels<uint32_t>(pixels, reader);
        image.ids.floats = readChannels<float>(pixels, reader);
        image.ids.attributes = readMetadata(reader);
        if (const std::string film = reader.text(); !film.empty())
            image.film = filmFromBytes(film, "its film");
        image.holdsFilm = reader.number() != 0 && image.film;
        if (reader.number() != 0)
            image.tone = readTone(reader);
        image.pixels = reader.array<uint32_t>();
        if (!image.pixels.empty() && image.pixels.size() != pixels)
            throw Error("it has another number of pixels to show");
        record.header = readMetadata(reader);
        record.report = reader.text();
        record.isComplete = reader.number() != 0;
        reader.requireEnd();
        return record;
    } catch (const Error& error) {
        throw Error(fmt::format("cannot read the image: {}", error.what()));
    }
}

} // namespace lavalight::python
