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
constexpr std::string_view kIds = ": ids";
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
#define PLANE_NUMBER(number, name, channels, components, sign, hasSquares, isPerHit) number,
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
#define PLANE_NAME(number, name, channels, components, sign, hasSquares, isPerHit) std::string_view(name),
    constexpr std::array names{FILM_PLANES(PLANE_NAME)};
#undef PLANE_NAME
    return names[kColorPlane] == kColorLayer && names[kCoveragePlane] == kCoverageLayer;
}
static_assert(haveKnownNames());

// What a row of FILM_PLANES is called.
struct Row {
    std::string name;
    std::vector<std::string> channels;
};

const std::vector<Row>& allRows() {
#define LAYER_ROW(number, name, channels, components, sign, hasSquares, isPerHit)                            \
    {name, channelsOf(channels)},
    static const std::vector<Row> rows{FILM_PLANES(LAYER_ROW)};
#undef LAYER_ROW
    return rows;
}

bool isOfRow(const LayerPlane& plane, uint32_t row) {
    return plane.name == allRows().at(row).name && plane.channels == allRows()[row].channels;
}

bool isIdLayer(std::string_view name) {
    return name == layerNameOf(kObjectIds) || name == layerNameOf(kMaterialIds);
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
    return !planes.empty() && planes.size() <= kMostPlanes && isOfRow(planes.front(), kColorPlane) &&
           names.size() == planes.size() && channels.size() == components;
}

} // namespace

bool operator==(const LayerPlane& a, const LayerPlane& b) {
    return a.name == b.name && a.channels == b.channels && a.shape.components == b.shape.components &&
           a.isSigned() == b.isSigned() && a.hasSquares() == b.hasSquares() && a.isPerHit() == b.isPerHit();
}

FilmLayout::FilmLayout(std::vector<LayerPlane> planes, std::vector<std::string> idLayers)
    : planes_(std::move(planes)), idLayers_(std::move(idLayers)) {
    assert(areLayers(planes_));
    firstWords_.push_back(0);
    for (const LayerPlane& plane : planes_) {
        assert(plane.channels.size() == plane.shape.components);
        firstWords_.push_back(firstWords_.back() + wordsOf(plane.shape));
    }
}

std::optional<size_t> FilmLayout::find(uint32_t row) const {
    const auto found = std::find_if(planes_.begin(), planes_.end(),
                                    [&](const LayerPlane& plane) { return isOfRow(plane, row); });
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
    return allRows().at(row).name;
}

std::string layerNameOf(uint32_t bit) {
    return bit == kObjectIds ? "object-id" : bit == kMaterialIds ? "material-id" : "cryptomatte";
}

std::vector<std::string> layerNames(uint32_t asked) {
    std::vector<std::string> names;
    for (uint32_t row = 0; row < kFilmPlaneCount; ++row)
        if ((asked >> row & 1u) != 0)
            names.push_back(planeName(row));
    for (const uint32_t bit : {kObjectIds, kMaterialIds, kCryptomatte})
        if ((asked & bit) != 0)
            names.push_back(layerNameOf(bit));
    return names;
}

std::vector<uint32_t> offeredRows() {
    constexpr uint32_t kNeeded = 1u << kColorPlane | 1u << kCoveragePlane | 1u << kHitsPlane |
                                 1u << kShadowPlane | 1u << kBehindPlane | 1u << kGuideAlbedoPlane |
                                 1u << kGuideNormalPlane;
    std::vector<uint32_t> rows;
    for (uint32_t row = 0; row < kFilmPlaneCount; ++row)
        if ((kNeeded >> row & 1u) == 0)
            rows.push_back(row);
    return rows;
}

FilmLayout layoutOf(uint32_t asked) {
    std::vector<LayerPlane> planes;
    for (uint32_t i = 0; i < kFilmPlaneCount; ++i)
        if ((asked >> i & 1u) != 0)
            planes.push_back({allRows()[i].name, allRows()[i].channels, shapeOf(i, asked)});
    std::vector<std::string> ids;
    for (const uint32_t bit : {kObjectIds, kMaterialIds})
        if ((asked & bit) != 0)
            ids.push_back(layerNameOf(bit));
    return FilmLayout(std::move(planes), std::move(ids));
}

const FilmLayout& colorLayout() {
    static const FilmLayout layout = layoutOf(1u << kColorPlane);
    return layout;
}

std::string textOf(const FilmLayout& layout) {
    std::string text;
    for (const LayerPlane& plane : layout.planes())
        text += fmt::format("{}{}", text.empty() ? "" : kBetweenPlanes, planeText(plane));
    for (const std::string& name : layout.idLayers())
        text += fmt::format("{}{}{}", kBetweenPlanes, name, kIds);
    return text;
}

std::optional<FilmLayout> parseFilmLayout(std::string_view text) {
    std::vector<LayerPlane> planes;
    std::vector<std::string> ids;
    for (const std::string_view part : split(text, kBetweenPlanes)) {
        if (part.ends_with(kIds)) {
            ids.emplace_back(part.substr(0, part.size() - kIds.size()));
            continue;
        }
        if (!ids.empty())
            return std::nullopt;
        const std::optional<LayerPlane> plane = parsePlane(part);
        if (!plane)
            return std::nullopt;
        planes.push_back(*plane);
    }
    const bool areIds =
        ids.empty() || ids == layoutOf(~0u).idLayers() || (ids.size() == 1 && isIdLayer(ids.front()));
    return areIds && areLayers(planes) ? std::optional(FilmLayout(std::move(planes), std::move(ids)))
                                       : std::nullopt;
}

} // namespace lavalight
