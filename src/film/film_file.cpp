#include "film/film_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>
#include <optional>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/content_hash.h"
#include "base/error.h"
#include "base/parse.h"
#include "film/cryptomatte.h"
#include "film/id_layers.h"

namespace lavalight {
namespace {

constexpr uint32_t kMostIdRanks = 1u << 16;
constexpr const char* kRanges = "film:ranges";
constexpr const char* kProgress = "film:progress";
constexpr const char* kTallies = "film:tallies";
constexpr const char* kLayout = "film:layout";
constexpr const char* kImage = "film:image";
constexpr const char* kWindows = "film:windows";
constexpr const char* kIdDepths = "film:id-depths";
constexpr const char* kHash = "film:hash";

const std::set<std::string> kOwnKeys{kRanges, kProgress, kTallies,  kLayout,
                                     kImage,  kWindows,  kIdDepths, kHash};

// Channels of the film's words in their order; the last is the channel of counts that every image has.
std::vector<std::string> wordNames(const FilmLayout& layout) {
    std::vector<std::string> names;
    for (const FilmNumber& number : layout.numbers())
        for (uint32_t word = 0; word < number.words; ++word)
            names.push_back(fmt::format("raw.{}.{}", number.name, word));
    names.emplace_back(kSampleChannel);
    assert(names.size() == layout.words());
    return names;
}

// The channels of a layer of ids: of each rank the id and its count.
std::vector<std::string> idNames(const std::string& layer, size_t depth) {
    std::vector<std::string> names;
    for (size_t rank = 0; rank < depth; ++rank) {
        names.push_back(fmt::format("ids.{}.{}.id", layer, rank));
        names.push_back(fmt::format("ids.{}.{}.count", layer, rank));
    }
    return names;
}

// Ranks of each layer of ids.
std::vector<size_t> depthsIn(const Metadata& metadata, const FilmLayout& layout) {
    std::vector<size_t> depths;
    const std::string all = valueOf(metadata, kIdDepths);
    std::string_view text = all;
    for (size_t i = 0; i < layout.idLayers().size(); ++i) {
        if (i > 0 && text.starts_with(','))
            text.remove_prefix(1);
        const auto depth = takeNumber<uint32_t>(text);
        if (!depth || *depth > kMostIdRanks)
            throw Error("its header does not say how many ids its pixels have");
        depths.push_back(*depth);
    }
    return depths;
}

std::string depthsText(const std::vector<IdLayer>& ids) {
    std::vector<size_t> depths;
    for (const IdLayer& layer : ids)
        depths.push_back(layer.counts.deepest());
    return fmt::format("{}", fmt::join(depths, ","));
}

// The ids at the end of a file's words.
std::vector<IdLayer> idsIn(std::span<const uint32_t> values, const std::vector<size_t>& depths,
                           const FilmLayout& layout, size_t pixels) {
    std::vector<IdLayer> layers = emptyIds(layout, pixels);
    for (size_t i = 0; i < layers.size(); ++i)
        for (size_t rank = 0; rank < depths[i]; ++rank) {
            for (size_t pixel = 0; pixel < pixels; ++pixel)
                if (const uint32_t count = values[pixels + pixel]; count > 0)
                    layers[i].counts.add(pixel, values[pixel], count);
            values = values.subspan(2 * pixels);
        }
    return layers;
}

// Channels of the film's ids, in the order of idNames().
std::vector<OwnedChannel<uint32_t>> idChannels(const RawFilm& film) {
    std::vector<OwnedChannel<uint32_t>> channels;
    for (const IdLayer& layer : film.ids) {
        const size_t first = channels.size();
        for (const std::string& name : idNames(layer.name, layer.counts.deepest()))
            channels.push_back({name, std::vector<uint32_t>(film.pixels())});
        for (size_t pixel = 0; pixel < film.pixels(); ++pixel) {
            size_t at = first;
            for (const IdCount& counted : layer.counts.ranked(pixel)) {
                channels[at++].values[pixel] = counted.id;
                channels[at++].values[pixel] = counted.count;
            }
        }
    }
    return channels;
}

// Files from before there were other layers do not say that they have colour alone.
FilmLayout layoutIn(const Metadata& metadata) {
    const std::string text = valueOf(metadata, kLayout);
    if (text.empty())
        return colorLayout();
    if (const std::optional<FilmLayout> layout = parseFilmLayout(text))
        return *layout;
    throw Error(fmt::format("its film has the layers \"{}\", which this version does not understand; try the "
                            "version that wrote it",
                            text));
}

// The part of an image that a film of these sides is by its header. Films of whole images say nothing of it.
std::optional<FilmPart> partIn(const Metadata& metadata, uint32_t width, uint32_t height) {
    const std::string windows = valueOf(metadata, kWindows);
    if (windows.empty())
        return std::nullopt;
    const auto whole = parsePixelWindow("0,0," + valueOf(metadata, kImage));
    const auto parts = parsePixelWindows(windows);
    if (!whole || !parts)
        throw Error("its header does not say which part of an image it is");
    const PixelWindow bounds = boundsOf(*parts);
    if (bounds.width != width || bounds.height != height || bounds.right() > whole->width ||
        bounds.bottom() > whole->height)
        throw Error("its header contradicts itself about the part of an image that it is");
    return FilmPart{{whole->width, whole->height}, *parts};
}

struct Size {
    uint32_t width;
    uint32_t height;
};

std::string hashOf(Size size, const std::vector<uint32_t>& words, Metadata metadata) {
    std::sort(metadata.begin(), metadata.end());
    ContentHash hash;
    hash.add(std::vector{size});
    hash.add(words);
    for (const auto& [key, value] : metadata) {
        if (key == kHash)
            continue;
        hash.add(key);
        hash.add(value);
    }
    return hash.text();
}

// Up to N numbers with commas between, at least `least`; the rest is 0.
template <typename Number, size_t N>
std::optional<std::array<Number, N>> parseNumbers(std::string_view text, size_t least = N) {
    std::array<Number, N> numbers{};
    for (size_t i = 0; i < N && (i < least || !text.empty()); ++i) {
        if (i > 0 && !text.starts_with(','))
            return std::nullopt;
        text.remove_prefix(i > 0 ? 1 : 0);
        const auto number = takeNumber<Number>(text);
        if (!number)
            return std::nullopt;
        numbers[i] = *number;
    }
    return text.empty() ? std::optional(numbers) : std::nullopt;
}

// Tallies of the oldest films; later versions count more.
constexpr size_t kFewestTallies = 6;

bool isPossible(const FilmProgress& progress, const SampleRanges& ranges, size_t pixels) {
    return uint64_t{progress.samples} + progress.passSamples <= countOf(ranges) &&
           (progress.passSamples > 0 || progress.passPixels == 0) && progress.passPixels < pixels;
}

// All channels of a film file that are read back, in the order of UintImage's values.
std::vector<std::string> channelNames(const Metadata& metadata) {
    const FilmLayout layout = layoutIn(metadata);
    std::vector<std::string> names = wordNames(layout);
    const std::vector<size_t> depths = depthsIn(metadata, layout);
    for (size_t i = 0; i < depths.size(); ++i)
        for (std::string& name : idNames(layout.idLayers()[i], depths[i]))
            names.push_back(std::move(name));
    return names;
}

} // namespace

UintImage storedFilm(const FilmFile& file) {
    const RawFilm& film = file.film;
    UintImage stored{film.width, film.height, film.words, file.metadata};
    Metadata& metadata = stored.metadata;
    metadata.emplace_back(kRanges, textOf(file.ranges));
    metadata.emplace_back(kProgress, fmt::format("{},{},{}", file.progress.samples, file.progress.passSamples,
                                                 file.progress.passPixels));
    metadata.emplace_back(kTallies, fmt::format("{}", fmt::join(film.tallies, ",")));
    metadata.emplace_back(kLayout, textOf(film.layout));
    if (!film.ids.empty())
        metadata.emplace_back(kIdDepths, depthsText(film.ids));
    if (file.part) {
        metadata.emplace_back(kImage, fmt::format("{}x{}", file.part->whole.x, file.part->whole.y));
        metadata.emplace_back(kWindows, textOf(file.part->windows));
    }
    for (const OwnedChannel<uint32_t>& channel : idChannels(film))
        stored.values.insert(stored.values.end(), channel.values.begin(), channel.values.end());
    metadata.emplace_back(kHash, hashOf({film.width, film.height}, stored.values, metadata));
    return stored;
}

FilmFile filmOf(UintImage image) {
    // What cryptomattes say follows from the ids.
    std::erase_if(image.metadata,
                  [](const auto& pair) { return pair.first.starts_with(kCryptomatteAttribute); });
    const auto ranges = parseSampleRanges(valueOf(image.metadata, kRanges));
    const auto tallies =
        parseNumbers<uint64_t, kTallyCount>(valueOf(image.metadata, kTallies), kFewestTallies);
    const auto progress = parseNumbers<uint32_t, 3>(valueOf(image.metadata, kProgress));
    if (!ranges || !tallies || !progress)
        throw Error("its header does not say which samples it holds");
    if (hashOf({image.width, image.height}, image.values, image.metadata) != valueOf(image.metadata, kHash))
        throw Error("it was damaged: its film or header is not what was written");
    FilmFile file{{image.width, image.height, {}, *tallies, layoutIn(image.metadata)},
                  *ranges,
                  {(*progress)[0], (*progress)[1], (*progress)[2]},
                  std::move(image.metadata)};
    const size_t words = file.film.layout.words() * file.film.pixels();
    const std::vector<size_t> depths = depthsIn(file.metadata, file.film.layout);
    if (image.values.size() != words + 2 * std::reduce(depths.begin(), depths.end()) * file.film.pixels())
        throw Error("it has other planes than its header says");
    file.film.ids =
        idsIn(std::span(image.values).subspan(words), depths, file.film.layout, file.film.pixels());
    image.values.resize(words);
    file.film.words = std::move(image.values);
    file.part = partIn(file.metadata, image.width, image.height);
    if (!isPossible(file.progress, file.ranges, file.film.pixels()))
        throw Error("its header contradicts itself about the samples that it holds");
    std::erase_if(file.metadata, [](const auto& pair) { return kOwnKeys.contains(pair.first); });
    return file;
}

void writeFilmFile(const std::filesystem::path& path, const FilmFile& file, std::span<const Layer> more) {
    Rendering rendering = resolve(file.film);
    if (file.part)
        rendering.place = placeOf(*file.part);
    ExrContents contents;
    addIdLayers(file.film.ids, rendering.sampleCounts, file.metadata, contents);
    const UintImage stored = storedFilm(file);
    const std::vector<std::string> names = channelNames(stored.metadata);
    const size_t pixels = file.film.pixels();
    for (size_t plane = 0; plane < names.size(); ++plane)
        if (names[plane] != kSampleChannel) // every image has it
            contents.words.push_back(
                {names[plane], std::span(stored.values).subspan(plane * pixels, pixels)});
    rendering.layers.insert(rendering.layers.end(), more.begin(), more.end());
    writeExr(path, rendering, stored.metadata, contents);
}

FilmFile readFilmFile(const std::filesystem::path& path) {
    std::optional<UintImage> image = readUintChannels(path, channelNames);
    try {
        if (!image)
            throw Error("it holds no exact film, as images of render --samples A:B and of merge do");
        return filmOf(std::move(*image));
    } catch (const Error& error) {
        throw Error(fmt::format("cannot read {}: {}", path.string(), error.what()));
    }
}

FilmState readFilmState(const std::filesystem::path& path) {
    const ExrHeader header = readExrHeader(path);
    const auto ranges = parseSampleRanges(valueOf(header.metadata, kRanges));
    const auto progress = parseNumbers<uint32_t, 3>(valueOf(header.metadata, kProgress));
    if (!ranges || !progress)
        throw Error(
            fmt::format("cannot read {}: its header does not say which samples it holds", path.string()));
    const auto [samples, passSamples, passPixels] = *progress;
    const double pixels = static_cast<double>(header.width) * header.height;
    const double ofPass = pixels > 0.0 ? passSamples * (passPixels / pixels) : 0.0;
    return {(samples + ofPass) / countOf(*ranges),
            parseNumber<double>(valueOf(header.metadata, "render-seconds")).value_or(0.0)};
}

std::string valueOf(const Metadata& metadata, const std::string& key) {
    const auto found =
        std::find_if(metadata.begin(), metadata.end(), [&](const auto& pair) { return pair.first == key; });
    return found == metadata.end() ? std::string() : found->second;
}

void setValue(Metadata& metadata, const std::string& key, const std::string& value) {
    const auto found =
        std::find_if(metadata.begin(), metadata.end(), [&](const auto& pair) { return pair.first == key; });
    if (found != metadata.end())
        found->second = value;
    else
        metadata.emplace_back(key, value);
}

} // namespace lavalight
