#include "film/film_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/content_hash.h"
#include "base/error.h"
#include "base/parse.h"

namespace lavalight {
namespace {

constexpr const char* kRanges = "film:ranges";
constexpr const char* kProgress = "film:progress";
constexpr const char* kTallies = "film:tallies";
constexpr const char* kLayout = "film:layout";
constexpr const char* kHash = "film:hash";

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

FilmFile understood(UintImage image) {
    const auto ranges = parseSampleRanges(valueOf(image.metadata, kRanges));
    const auto tallies =
        parseNumbers<uint64_t, kTallyCount>(valueOf(image.metadata, kTallies), kFewestTallies);
    const auto progress = parseNumbers<uint32_t, 3>(valueOf(image.metadata, kProgress));
    if (!ranges || !tallies || !progress)
        throw Error("its header does not say which samples it holds");
    if (hashOf({image.width, image.height}, image.values, image.metadata) != valueOf(image.metadata, kHash))
        throw Error("it was damaged: its film or header is not what was written");
    FilmFile file{{image.width, image.height, std::move(image.values), *tallies, layoutIn(image.metadata)},
                  *ranges,
                  {(*progress)[0], (*progress)[1], (*progress)[2]},
                  std::move(image.metadata)};
    if (!isPossible(file.progress, file.ranges, file.film.pixels()))
        throw Error("its header contradicts itself about the samples that it holds");
    std::erase_if(file.metadata, [](const auto& pair) {
        return pair.first == kRanges || pair.first == kProgress || pair.first == kTallies ||
               pair.first == kLayout || pair.first == kHash;
    });
    return file;
}

} // namespace

void writeFilmFile(const std::filesystem::path& path, const FilmFile& file) {
    const FilmProgress& progress = file.progress;
    Metadata metadata = file.metadata;
    metadata.emplace_back(kRanges, textOf(file.ranges));
    metadata.emplace_back(
        kProgress, fmt::format("{},{},{}", progress.samples, progress.passSamples, progress.passPixels));
    metadata.emplace_back(kTallies, fmt::format("{}", fmt::join(file.film.tallies, ",")));
    metadata.emplace_back(kLayout, textOf(file.film.layout));
    metadata.emplace_back(kHash, hashOf({file.film.width, file.film.height}, file.film.words, metadata));
    const std::vector<std::string> names = wordNames(file.film.layout);
    std::vector<UintChannel> channels;
    for (size_t word = 0; word < file.film.layout.countWord(); ++word)
        channels.push_back(
            {names[word], std::span(file.film.words).subspan(word * file.film.pixels(), file.film.pixels())});
    writeExr(path, resolve(file.film), metadata, channels);
}

FilmFile readFilmFile(const std::filesystem::path& path) {
    std::optional<UintImage> image =
        readUintChannels(path, [](const Metadata& metadata) { return wordNames(layoutIn(metadata)); });
    try {
        if (!image)
            throw Error("it holds no exact film, as images of render --samples A:B and of merge do");
        return understood(std::move(*image));
    } catch (const Error& error) {
        throw Error(fmt::format("cannot read {}: {}", path.string(), error.what()));
    }
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
