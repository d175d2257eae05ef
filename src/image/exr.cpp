#include "image/exr.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <string_view>
#include <thread>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <fmt/format.h>
#include <openexr.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "image/exr_header_check.h"
#include "image/exr_layers.h"
#include "image/exr_sphere.h"

namespace lavalight {
namespace {

constexpr std::string_view kPrefix = "lavalight:";
using ChannelList = std::vector<std::string>;

// ZIP keeps every core busy: 3840 x 2160 with seven channels takes seconds on one.
void useAllCores() {
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    if (Imf::globalThreadCount() != cores)
        Imf::setGlobalThreadCount(cores);
}

// --- writing ---

void addChannel(Imf::Header& header, Imf::FrameBuffer& buffer, const std::string& name, Imf::PixelType type,
                const void* first, size_t stride) {
    const Imath::Box2i& window = header.dataWindow();
    const size_t width = static_cast<size_t>(window.size().x) + 1;
    header.channels().insert(name, Imf::Channel(type));
    buffer.insert(name, Imf::Slice::Make(type, first, window, stride, stride * width));
}

void addImage(Imf::Header& header, Imf::FrameBuffer& buffer, const ChannelList& names, const Image& image) {
    for (size_t c = 0; c < names.size(); ++c)
        addChannel(header, buffer, names[c], Imf::FLOAT, &image.pixels.front()[static_cast<glm::length_t>(c)],
                   sizeof(glm::vec3));
}

// Pixels from `first` on.
Imath::Box2i windowOf(glm::uvec2 first, glm::uvec2 size) {
    const glm::ivec2 least(first);
    const glm::ivec2 most = least + glm::ivec2(size) - 1;
    return {{least.x, least.y}, {most.x, most.y}};
}

Imath::Box2i dataWindow(const Rendering& rendering) {
    const Image& image = rendering.radiance();
    return windowOf(rendering.place ? rendering.place->first : glm::uvec2(0), {image.width, image.height});
}

Imath::Box2i displayWindow(const Rendering& rendering) {
    return rendering.place ? windowOf(glm::uvec2(0), rendering.place->whole) : dataWindow(rendering);
}

void writeChannels(const std::filesystem::path& part, const Rendering& rendering, const Metadata& metadata,
                   const ExrContents& more) {
    Imf::Header header(displayWindow(rendering), dataWindow(rendering));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities()); // the default is Rec. 709
    for (const auto& [key, value] : metadata)
        header.insert(std::string(kPrefix) + key, Imf::StringAttribute(value));
    for (const auto& [name, value] : more.attributes)
        header.insert(name, Imf::StringAttribute(value));
    Imf::FrameBuffer buffer;
    for (const Layer& layer : rendering.layers) {
        addImage(header, buffer, layer.channels, layer.mean);
        if (layer.variance)
            addImage(header, buffer, varianceChannels(layer.channels), *layer.variance);
    }
    addChannel(header, buffer, kSampleChannel, Imf::UINT, rendering.sampleCounts.data(), sizeof(uint32_t));
    for (const UintChannel& channel : more.words)
        addChannel(header, buffer, channel.name, Imf::UINT, channel.values.data(), sizeof(uint32_t));
    for (const OwnedChannel<uint32_t>& channel : more.uints)
        addChannel(header, buffer, channel.name, Imf::UINT, channel.values.data(), sizeof(uint32_t));
    for (const OwnedChannel<float>& channel : more.floats)
        addChannel(header, buffer, channel.name, Imf::FLOAT, channel.values.data(), sizeof(float));
    std::ofstream stream(part, std::ios::binary);
    {
        Imf::StdOFStream out(stream, part.c_str());
        Imf::OutputFile file(out, header);
        file.setFrameBuffer(buffer);
        file.writePixels(static_cast<int>(rendering.radiance().height));
    } // writes where the lines are, and swallows what goes wrong with that: the stream knows
    stream.close();
    if (!stream)
        throw Error(std::strerror(errno));
}

// --- reading ---

// The library's handler for errors; the context's user data is the string that keeps the message.
void keepMessage(exr_const_context_t context, exr_result_t, const char* message) {
    void* kept = nullptr;
    if (exr_get_user_data(context, &kept) == EXR_ERR_SUCCESS && kept != nullptr)
        *static_cast<std::string*>(kept) = message;
}

// The C++ reader allocates whatever a header claims (2 GB for one damaged attribute), so the C reader, which
// holds each claim against the size of the file and against our limits, goes first.
void requireSaneHeader(const std::filesystem::path& path) {
    constexpr int kLimit = static_cast<int>(kMaxImageSide);
    std::string message;
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = keepMessage;
    settings.user_data = &message;
    settings.max_image_width = settings.max_image_height = kLimit;
    settings.max_tile_width = settings.max_tile_height = kLimit;
    exr_context_t context = nullptr;
    const exr_result_t result = exr_start_read(&context, path.c_str(), &settings);
    exr_finish(&context);
    if (!message.empty()) // it skips damaged attributes, and reports success all the same
        throw Error(message);
    if (result != EXR_ERR_SUCCESS)
        throw Error(exr_get_default_error_message(result));
}

// Subsampled channels do not count.
bool isWhole(const Imf::Channel* channel) {
    return channel != nullptr && channel->xSampling == 1 && channel->ySampling == 1;
}

std::vector<ExrChannel> channelsOf(const Imf::InputFile& file) {
    const Imf::ChannelList& list = file.header().channels();
    std::vector<ExrChannel> channels;
    for (auto i = list.begin(); i != list.end(); ++i)
        channels.push_back({i.name(), i.channel().type != Imf::UINT, isWhole(&i.channel())});
    return channels;
}

void warnIfNotRec709(const Imf::Header& header, const std::filesystem::path& path) {
    if (!Imf::hasChromaticities(header))
        return;
    const Imf::Chromaticities file = Imf::chromaticities(header);
    const Imf::Chromaticities ours;
    const auto equal = [](const Imath::V2f& a, const Imath::V2f& b) {
        constexpr float kRounding =
            1e-3f; // xy; writers store three or four digits, and no two standards are so close
        return (a - b).length() < kRounding;
    };
    if (!equal(file.red, ours.red) || !equal(file.green, ours.green) || !equal(file.blue, ours.blue))
        spdlog::warn("{}: its primaries are not those of Rec. 709; its colours are used unconverted",
                     path.string());
}

// Pixel arrays bound to the channels of a file. They grow band by band into a reservation made at the start,
// so that a small damaged file that claims 16384 x 16384 pixels fails before we have touched gigabytes.
class PixelReader {
  public:
    PixelReader(Imf::InputFile& file, uint64_t mostPixels, uint64_t bytesEach)
        : file_(file), window_(file.header().dataWindow()),
          width_(static_cast<uint32_t>(window_.max.x - window_.min.x + 1)),
          height_(static_cast<uint32_t>(window_.max.y - window_.min.y + 1)) {
        requirePixelsFit(width_, height_, mostPixels, bytesEach);
    }

    void bindImage(Image& image, const ChannelList& names) {
        reserve(image);
        for (size_t c = 0; c < names.size(); ++c)
            bind(names[c].c_str(), Imf::FLOAT, reinterpret_cast<float*>(image.pixels.data()) + c,
                 sizeof(glm::vec3));
    }

    void bindCounts(std::vector<uint32_t>& counts, const char* name) {
        counts.reserve(size_t{width_} * height_);
        counts_.push_back(&counts);
        bind(name, Imf::UINT, counts.data(), sizeof(uint32_t));
    }

    void read() {
        constexpr uint32_t kBand = 256; // rows; at most 50 MB of colour ahead of the data
        file_.setFrameBuffer(buffer_);
        for (uint32_t row = 0; row < height_; row += kBand) {
            const uint32_t end = std::min(row + kBand, height_);
            for (Image* image : images_)
                image->pixels.resize(size_t{end} * width_);
            for (std::vector<uint32_t>* counts : counts_)
                counts->resize(size_t{end} * width_);
            file_.readPixels(window_.min.y + static_cast<int>(row),
                             window_.min.y + static_cast<int>(end) - 1);
        }
    }

  private:
    void reserve(Image& image) {
        image.width = width_;
        image.height = height_;
        image.pixels.reserve(size_t{width_} * height_);
        images_.push_back(&image);
    }

    void bind(const char* name, Imf::PixelType type, const void* first, size_t stride) {
        buffer_.insert(name, Imf::Slice::Make(type, first, window_, stride, stride * width_));
    }

    Imf::InputFile& file_;
    const Imath::Box2i window_;
    const uint32_t width_;
    const uint32_t height_;
    std::vector<Image*> images_;
    std::vector<std::vector<uint32_t>*> counts_;
    Imf::FrameBuffer buffer_;
};

Metadata readMetadata(const Imf::Header& header) {
    Metadata metadata;
    for (auto i = header.begin(); i != header.end(); ++i) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&i.attribute());
        if (text == nullptr)
            continue;
        const std::string_view name = i.name();
        metadata.emplace_back(name.starts_with(kPrefix) ? name.substr(kPrefix.size()) : name, text->value());
    }
    return metadata;
}

// Grey images have one channel.
void spreadGrey(Layer& layer) {
    if (layer.channels.size() > 1)
        return;
    for (glm::vec3& pixel : layer.mean.pixels)
        pixel = glm::vec3(pixel.x);
    layer.channels = colorLayer({}, std::nullopt).channels;
}

Image readSphere(Imf::InputFile& file, uint64_t mostPixels) {
    Layer layer = colorLayerIn(channelsOf(file));
    PixelReader reader(file, mostPixels, sizeof(glm::vec3));
    reader.bindImage(layer.mean, layer.channels);
    reader.read();
    spreadGrey(layer);
    return aroundSphere(std::move(layer.mean), file.header(), mostPixels);
}

// Display windows may begin anywhere, and data windows leave them.
std::optional<ImagePlace> placeIn(const Imf::Header& header) {
    const Imath::Box2i& whole = header.displayWindow();
    const Imath::Box2i& data = header.dataWindow();
    if (whole == data || !whole.intersects(data.min) || !whole.intersects(data.max))
        return std::nullopt;
    const Imath::V2i first = data.min - whole.min;
    const Imath::V2i size = whole.size() + Imath::V2i(1);
    return ImagePlace{glm::uvec2(first.x, first.y), glm::uvec2(size.x, size.y)};
}

ExrFile readLayers(Imf::InputFile& file) {
    ExrFile result;
    result.layers = layersIn(channelsOf(file));
    size_t images = 0;
    for (const Layer& layer : result.layers)
        images += layer.variance ? 2 : 1;
    PixelReader reader(file, kMaxImagePixels, images * sizeof(glm::vec3) + sizeof(uint32_t));
    for (Layer& layer : result.layers) {
        reader.bindImage(layer.mean, layer.channels);
        if (layer.variance)
            reader.bindImage(*layer.variance, varianceChannels(layer.channels));
    }
    if (isWhole(file.header().channels().findChannel(kSampleChannel)))
        reader.bindCounts(result.sampleCounts, kSampleChannel);
    reader.read();
    spreadGrey(result.layers.front());
    result.metadata = readMetadata(file.header());
    result.place = placeIn(file.header());
    return result;
}

std::optional<UintImage> readCounts(Imf::InputFile& file, const ChannelNames& namesIn) {
    const Imf::ChannelList& channels = file.header().channels();
    Metadata metadata = readMetadata(file.header());
    const ChannelList names = namesIn(metadata);
    for (const std::string& name : names)
        if (const Imf::Channel* channel = channels.findChannel(name);
            !isWhole(channel) || channel->type != Imf::UINT)
            return std::nullopt;
    const Imath::Box2i window = file.header().dataWindow();
    UintImage image{static_cast<uint32_t>(window.max.x - window.min.x + 1),
                    static_cast<uint32_t>(window.max.y - window.min.y + 1),
                    {},
                    std::move(metadata)};
    std::vector<std::vector<uint32_t>> planes(names.size());
    PixelReader reader(file, kMaxImagePixels, 2 * sizeof(uint32_t) * names.size()); // with the copy below
    for (size_t i = 0; i < names.size(); ++i)
        reader.bindCounts(planes[i], names[i].c_str());
    reader.read();
    for (std::vector<uint32_t>& plane : planes) {
        image.values.insert(image.values.end(), plane.begin(), plane.end());
        plane = {};
    }
    return image;
}

// OpenEXR's messages begin with the file's name, which ours name already.
std::string reason(const std::exception& error, const std::filesystem::path& path) {
    const std::string message = error.what();
    const std::string name = fmt::format("\"{}\". ", path.string());
    const size_t at = message.find(name);
    return at == std::string::npos ? message : message.substr(at + name.size());
}

template <typename Read>
auto readWith(const std::filesystem::path& path, const Read& read) {
    requireRegularFile(path);
    useAllCores();
    try {
        requireSaneAttributes(path);
        requireSaneHeader(path);
        Imf::InputFile file(path.c_str());
        return read(file);
    } catch (const std::bad_alloc&) {
        throw Error(fmt::format("cannot read {}: its pixels do not fit into memory", path.string()));
    } catch (const std::exception& error) {
        throw Error(fmt::format("cannot read {}: {}", path.string(), reason(error, path)));
    }
}

} // namespace

void writeExr(const std::filesystem::path& path, const Rendering& rendering, const Metadata& metadata,
              const ExrContents& more) {
    [[maybe_unused]] const Image& image = rendering.radiance();
    assert(image.width > 0 && image.height > 0 && image.width <= kMaxImageSide &&
           image.height <= kMaxImageSide);
    for ([[maybe_unused]] const Layer& layer : rendering.layers) {
        assert(layer.mean.pixels.size() == image.pixels.size());
        assert(!layer.variance || layer.variance->pixels.size() == image.pixels.size());
        assert(!layer.channels.empty() && layer.channels.size() <= kMostComponents);
    }
    assert(rendering.sampleCounts.size() == image.pixels.size());
    useAllCores();
    writeFileAtomically(path, [&](const std::filesystem::path& part) {
        try {
            writeChannels(part, rendering, metadata, more);
        } catch (const std::exception& error) {
            throw Error(fmt::format("cannot write {}: {}", path.string(), reason(error, part)));
        }
    });
}

ExrFile readExr(const std::filesystem::path& path) {
    return readWith(path, [&](Imf::InputFile& file) {
        warnIfNotRec709(file.header(), path);
        return readLayers(file);
    });
}

Image readExrEnvironment(const std::filesystem::path& path, uint64_t mostPixels) {
    return readWith(path, [&](Imf::InputFile& file) {
        warnIfNotRec709(file.header(), path);
        return readSphere(file, mostPixels);
    });
}

ExrHeader readExrHeader(const std::filesystem::path& path) {
    return readWith(path, [](Imf::InputFile& file) {
        const Imath::Box2i window = file.header().dataWindow();
        return ExrHeader{static_cast<uint32_t>(window.max.x - window.min.x + 1),
                         static_cast<uint32_t>(window.max.y - window.min.y + 1), readMetadata(file.header())};
    });
}

std::optional<UintImage> readUintChannels(const std::filesystem::path& path, const ChannelNames& namesIn) {
    return readWith(path, [&](Imf::InputFile& file) { return readCounts(file, namesIn); });
}

} // namespace lavalight
