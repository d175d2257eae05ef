// Which parts of an image a film holds: what --crop asks for, and what merge joins.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "image/rendering.h"

namespace lavalight {

// Pixels of an image, from its top left corner.
struct PixelWindow {
    uint32_t x = 0;
    uint32_t y = 0;
    uint32_t width = 0;
    uint32_t height = 0;
    bool operator==(const PixelWindow&) const = default;

    [[nodiscard]] uint32_t right() const { return x + width; }
    [[nodiscard]] uint32_t bottom() const { return y + height; }
    [[nodiscard]] uint64_t pixels() const { return uint64_t{width} * height; }
};

// Windows apart from each other, none empty.
using PixelWindows = std::vector<PixelWindow>;

// Windows as text and back: "0,0,8x6" and, of several, "0,0,8x6 8,0,8x6". A window ends within the largest
// image that there is.
[[nodiscard]] std::string textOf(const PixelWindow& window);
[[nodiscard]] std::string textOf(const PixelWindows& windows);
[[nodiscard]] std::optional<PixelWindow> parsePixelWindow(std::string_view text);
[[nodiscard]] std::optional<PixelWindows> parsePixelWindows(std::string_view text);

// The smallest window around all of them, of which there is at least one.
[[nodiscard]] PixelWindow boundsOf(const PixelWindows& windows);
[[nodiscard]] uint64_t pixelsOf(const PixelWindows& windows);

// A window of pixels that both hold.
[[nodiscard]] std::optional<PixelWindow> overlapOf(const PixelWindows& a, const PixelWindows& b);
// The windows of both, which must not overlap; windows that fill their bounds become one.
[[nodiscard]] PixelWindows unionOf(const PixelWindows& a, const PixelWindows& b);

// What a film shows of an image of `whole` pixels. It has the size of the bounds of `windows`; pixels outside
// the windows have no samples.
struct FilmPart {
    glm::uvec2 whole{0};
    PixelWindows windows;
    bool operator==(const FilmPart&) const = default;
};
[[nodiscard]] ImagePlace placeOf(const FilmPart& part);

} // namespace lavalight
