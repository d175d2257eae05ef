// Images in memory.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace lavalight {

// Pixels a side that images may have, in memory and in files.
inline constexpr uint32_t kMaxImageSide = 16384;

// Linear Rec. 709 pixels, row by row from the top.
struct Image {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<glm::vec3> pixels;

    Image() = default;
    Image(uint32_t w, uint32_t h) : width(w), height(h), pixels(size_t{w} * h, glm::vec3(0.0f)) {}

    [[nodiscard]] const glm::vec3& at(uint32_t x, uint32_t y) const {
        assert(x < width && y < height);
        return pixels[size_t{y} * width + x];
    }
};

} // namespace lavalight
