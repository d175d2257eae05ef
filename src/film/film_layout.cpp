#include "film/film_layout.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "image/rendering.h"

namespace lavalight {
namespace {

constexpr std::string_view kBetweenPlanes = "; ";
constexpr std::string_view kAfterName = ": ";
constexpr std::string_view kSquares = " squares";
constexpr std::string_view kPerHit = " per-hit";
constexpr size_t kMostComponents = 3;
constexpr size_t kMostPlanes = 32; // a film's planes are asked for by the bits of one word

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos)
            return parts;
        text.remove_prefix(end + separator.size());
    }
}

std::vector<std::string> channelsOf(std::string_view list) {
    const std::vector<std::string_view> names = split(list, ",");
    return {names.begin(), names.end()};
}

// Whether the rows stand in the order of their numbers.
constexpr bool areInOrder() {
#define PLANE_NUMBER(number, name, channels, components, isSigned, hasSquares, isPerHit) number,
    constexpr std::array numbers{FILM_PLANES(PLANE_NUMBER)};
#undef PLANE_NUMBER
    for (size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i] != i)
            return false;
    return true;
}
static_assert(areInOrder());

// Whether the rows of planes that the rest of the house knows have the names that it knows.
constexpr bool haveKnownNames() {
#define PLANE_NAME(number, name, channels, components, isSigned, hasSquares, isPerHit) std::string_view(name),
    constexpr std::array names{FILM_PLANES(PLANE_NAME)};
#undef PLANE_NAME
    return names[kColorPlane] == kColorLayer && names[kCoveragePlane] == kCoverageLayer;
}
static_assert(haveKnownNames());

const std::vector<LayerPlane>& allPlanes() {
#define LAYER_PLANE(number, name, channels, components, isSigned, hasSquares, isPerHit)                      \
    {name, channelsOf(channels), {components, isSigned, hasSquares, isPerHit}},
    static const std::vector<LayerPlane> planes{FILM_PLANES(LAYER_PLANE)};
#undef LAYER_PLANE
    return planes;
}

bool isName(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
               c == '_' || c == '.';
    });
}

std::string planeText(const LayerPlane& plane) {
    return fmt::format("{}{}{} {}{}{}", plane.name, kAfterName, fmt::join(plane.channels, ","),
                       plane.isSigned() ? "signed" : "unsigned", plane.hasSquares() ? kSquares : "",
                       plane.isPerHit() ? kPerHit : "");
}

std::optional<LayerPlane> parsePlane(std::string_view text) {
    const size_t nameEnd = text.find(kAfterName);
    if (nameEnd == std::string_view::npos)
        return std::nullopt;
    const std::vector<std::string_view> words = split(text.substr(nameEnd + kAfterName.size()), " ");
    LayerPlane plane{std::string(text.substr(0, nameEnd)), channelsOf(words.front()), {}};
    plane.shape.components = static_cast<uint32_t>(plane.channels.size());
    plane.shape.isSigned = words.size() > 1 && words[1] == "signed" ? 1 : 0;
    plane.shape.hasSquares = text.find(kSquares, nameEnd) != std::string_view::npos ? 1 : 0;
    plane.shape.isPerHit = text.ends_with(kPerHit) ? 1 : 0;
    const bool areNames =
        isName(plane.name) && std::all_of(plane.channels.begin(), plane.channels.end(), isName);
    // A text that is written as it was read was read to its end.
    return areNames && plane.channels.size() <= kMostComponents && planeText(plane) == text
               ? std::optional(plane)
               : std::nullopt;
}

// Whether the colour comes first, and no name twice.
bool areLayers(const std::vector<LayerPlane>& planes) {
    std::set<std::string> names;
    std::set<std::string> channels;
    size_t components = 0;
    for (const LayerPlane& plane : planes) {
        names.insert(plane.name);
        channels.insert(plane.channels.begin(), plane.channels.end());
        components += plane.channels.size();
    }
    return !planes.empty() && planes.size() <= kMostPlanes && planes.front() == allPlanes()[kColorPlane] &&
           names.size() == planes.size() && channels.size() == components;
}

} // namespace

bool operator==(const LayerPlane& a, const LayerPlane& b) {
    return a.name == b.name && a.channels == b.channels && a.shape.components == b.shape.components &&
           a.isSigned() == b.isSigned() && a.hasSquares() == b.hasSquares() && a.isPerHit() == b.isPerHit();
}

FilmLayout::FilmLayout(std::vector<LayerPlane> planes) : planes_(std::move(planes)) {
    assert(areLayers(planes_));
    firstWords_.push_back(0);
    for (const LayerPlane& plane : planes_) {
        assert(plane.channels.size() == plane.shape.components);
        firstWords_.push_back(firstWords_.back() + wordsOf(plane.shape));
    }
}

std::optional<size_t> FilmLayout::find(uint32_t row) const {
    const auto found = std::find(planes_.begin(), planes_.end(), allPlanes().at(row));
    return found == planes_.end() ? std::nullopt : std::optional<size_t>(found - planes_.begin());
}

std::vector<FilmNumber> FilmLayout::numbers() const {
    std::vector<FilmNumber> numbers;
    uint32_t word = 0;
    const auto add = [&](const std::string& name, uint32_t words, bool isSigned) {
        numbers.push_back({name, word, words, isSigned});
        word += words;
    };
    for (const LayerPlane& plane : planes_)
        for (const std::string& channel : plane.channels) {
            add(channel + ".sum", sumWordsOf(plane.shape), plane.isSigned());
            if (plane.hasSquares())
                add(channel + ".square", kSquareWords, false);
        }
    assert(word == countWord());
    return numbers;
}

std::string planeName(uint32_t row) {
    return allPlanes().at(row).name;
}

FilmLayout layoutOf(uint32_t asked) {
    std::vector<LayerPlane> planes;
    for (uint32_t i = 0; i < kFilmPlaneCount; ++i)
        if ((asked >> i & 1u) != 0)
            planes.push_back(allPlanes()[i]);
    return FilmLayout(std::move(planes));
}

const FilmLayout& colorLayout() {
    static const FilmLayout layout = layoutOf(1u << kColorPlane);
    return layout;
}

std::string textOf(const FilmLayout& layout) {
    std::string text;
    for (const LayerPlane& plane : layout.planes())
        text += fmt::format("{}{}", text.empty() ? "" : kBetweenPlanes, planeText(plane));
    return text;
}

std::optional<FilmLayout> parseFilmLayout(std::string_view text) {
    std::vector<LayerPlane> planes;
    for (const std::string_view part : split(text, kBetweenPlanes)) {
        const std::optional<LayerPlane> plane = parsePlane(part);
        if (!plane)
            return std::nullopt;
        planes.push_back(*plane);
    }
    return areLayers(planes) ? std::optional(FilmLayout(std::move(planes))) : std::nullopt;
}

} // namespace lavalight
