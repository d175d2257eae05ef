// Which planes a film has, and where their words are (shaders/shared/film.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/film.h"

namespace lavalight {

// A plane, with the names of the layer that is made of it.
struct LayerPlane {
    std::string name;
    std::vector<std::string> channels; // in EXR files, one for each component
    FilmPlane shape{};

    [[nodiscard]] bool isSigned() const { return shape.isSigned != 0; }
    [[nodiscard]] bool hasSquares() const { return shape.hasSquares != 0; }
    [[nodiscard]] bool isPerHit() const { return shape.isPerHit != 0; }
};
[[nodiscard]] bool operator==(const LayerPlane& a, const LayerPlane& b);

// The sum or the sum of squares of one component: so many words, one after another.
struct FilmNumber {
    std::string name; // without a prefix: "R.sum"
    uint32_t firstWord = 0;
    uint32_t words = 0;
    bool isSigned = false;
};

class FilmLayout {
  public:
    // The first plane is the colour; names differ.
    explicit FilmLayout(std::vector<LayerPlane> planes, std::vector<std::string> idLayers = {});

    [[nodiscard]] std::span<const LayerPlane> planes() const { return planes_; }
    // Names of the layers for which ids are counted.
    [[nodiscard]] const std::vector<std::string>& idLayers() const { return idLayers_; }
    // Where the plane of a row of FILM_PLANES is among these, if it is.
    [[nodiscard]] std::optional<size_t> find(uint32_t row) const;
    // The index of the first word of a plane, of the word that counts samples, and the number of all words.
    [[nodiscard]] uint32_t firstWord(size_t plane) const { return firstWords_[plane]; }
    [[nodiscard]] uint32_t countWord() const { return firstWords_.back(); }
    [[nodiscard]] uint32_t words() const { return countWord() + 1; }
    // All numbers but the count, in the order of their words.
    [[nodiscard]] std::vector<FilmNumber> numbers() const;

    [[nodiscard]] bool operator==(const FilmLayout& other) const {
        return planes_ == other.planes_ && idLayers_ == other.idLayers_;
    }

  private:
    std::vector<LayerPlane> planes_;
    std::vector<std::string> idLayers_;
    std::vector<uint32_t> firstWords_; // where each plane begins, then the word of sample counts
};

// The name of the layer of a row of FILM_PLANES.
[[nodiscard]] std::string planeName(uint32_t row);
// The name of the layer of kObjectIds, kMaterialIds or kCryptomatte.
[[nodiscard]] std::string layerNameOf(uint32_t bit);
// Names of all layers that a word asks for.
[[nodiscard]] std::vector<std::string> layerNames(uint32_t asked);

// Rows of FILM_PLANES that a user may ask for as layers; the others come with what needs them.
[[nodiscard]] std::vector<uint32_t> offeredRows();

// Rows of FILM_PLANES, bit i for row i, kNegativeWeights, and layers of ids. The colour must be among them.
[[nodiscard]] FilmLayout layoutOf(uint32_t asked);
// The film of a render that no further layer was asked of.
[[nodiscard]] const FilmLayout& colorLayout();

// The layout as text for headers of files: "color: R,G,B unsigned squares; depth: depth.Z signed".
// parseFilmLayout() reads it back, and returns nothing for other text.
[[nodiscard]] std::string textOf(const FilmLayout& layout);
[[nodiscard]] std::optional<FilmLayout> parseFilmLayout(std::string_view text);

} // namespace lavalight
