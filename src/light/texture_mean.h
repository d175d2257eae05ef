// The mean of a texture over a triangle: what the power of a light with an emission texture depends on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lavalight {

class TextureMean {
  public:
    TextureMean(const Picture& picture, const Texture& texture);

    // Linear RGB. uvs: the corners' coordinates, before the texture's transform. Exact for the texture's wrap
    // modes and filter, up to kMostCells texels under the triangle; over more, for the picture in half, a
    // quarter, ... of its size. Above 0 wherever the triangle shows a texel that is not black.
    [[nodiscard]] glm::dvec3 over(const std::array<glm::vec2, 3>& uvs) const;

    static constexpr double kMostCells = 65536.0;

  private:
    // The picture, its size divided by a power of 2.
    struct Level {
        uint32_t width = 0;
        uint32_t height = 0;
        std::vector<glm::vec3> texels;
        // How many texels are not black above and to the left of each corner of the texels, in rows of
        // width + 1: most of most emission textures is black. Empty: none is.
        std::vector<uint32_t> lit;
    };
    struct Triangle { // in texels of a level
        std::array<glm::dvec2, 3> corners;
    };
    using Texels = std::array<glm::dvec3, 4>; // rows of two; of nearest texels the first alone
    // What the texture is made of between four texel centres, or in one texel.
    struct Cell {
        glm::dvec2 low;
        Texels texels;
    };

    [[nodiscard]] static Level halved(const Level& level);
    static void countLit(Level& level);
    [[nodiscard]] bool isBlackUnder(const Triangle& triangle, const Level& level) const;
    [[nodiscard]] Triangle onLevel(const std::array<glm::vec2, 3>& uvs, const Level& level) const;
    [[nodiscard]] glm::dvec3 texel(const Level& level, int64_t x, int64_t y) const;
    [[nodiscard]] Cell cellAt(const Level& level, int64_t x, int64_t y) const;
    [[nodiscard]] glm::dvec3 filtered(const Cell& cell, const glm::dvec2& p) const;
    [[nodiscard]] glm::dvec3 meanOver(const Triangle& triangle, const Level& level) const;
    [[nodiscard]] glm::dvec3 meanAlong(const Triangle& triangle, const Level& level) const;

    Texture texture_;
    std::vector<Level> levels_;
};

} // namespace lavalight
