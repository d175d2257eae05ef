#include "film/film_windows.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

#include "base/parse.h"
#include "image/pixel_limit.h"

namespace lavalight {
namespace {

// Takes "X,Y,WxH" off the front of `text`.
std::optional<PixelWindow> takeWindow(std::string_view& text) {
    PixelWindow window;
    const struct {
        uint32_t& number;
        std::string_view after;
    } parts[] = {{window.x, ","}, {window.y, ","}, {window.width, "x"}, {window.height, ""}};
    for (const auto& [number, after] : parts) {
        const auto taken = takeNumber<uint32_t>(text);
        if (!taken || *taken > kMaxImageSide || !text.starts_with(after))
            return std::nullopt;
        number = *taken;
        text.remove_prefix(after.size());
    }
    const bool fits = window.right() <= kMaxImageSide && window.bottom() <= kMaxImageSide;
    return fits && window.pixels() > 0 ? std::optional(window) : std::nullopt;
}

std::optional<PixelWindow> overlapOf(const PixelWindow& a, const PixelWindow& b) {
    const uint32_t x = std::max(a.x, b.x);
    const uint32_t y = std::max(a.y, b.y);
    const uint32_t right = std::min(a.right(), b.right());
    const uint32_t bottom = std::min(a.bottom(), b.bottom());
    return x < right && y < bottom ? std::optional(PixelWindow{x, y, right - x, bottom - y}) : std::nullopt;
}

} // namespace

std::string textOf(const PixelWindow& window) {
    return fmt::format("{},{},{}x{}", window.x, window.y, window.width, window.height);
}

std::string textOf(const PixelWindows& windows) {
    std::string text;
    for (const PixelWindow& window : windows)
        text += fmt::format("{}{}", text.empty() ? "" : " ", textOf(window));
    return text;
}

std::optional<PixelWindow> parsePixelWindow(std::string_view text) {
    const std::optional<PixelWindow> window = takeWindow(text);
    return text.empty() ? window : std::nullopt;
}

std::optional<PixelWindows> parsePixelWindows(std::string_view text) {
    PixelWindows windows;
    for (;;) {
        const std::optional<PixelWindow> window = takeWindow(text);
        if (!window || overlapOf(windows, {*window}))
            return std::nullopt;
        windows.push_back(*window);
        if (text.empty())
            return windows;
        if (text.front() != ' ')
            return std::nullopt;
        text.remove_prefix(1);
    }
}

PixelWindow boundsOf(const PixelWindows& windows) {
    assert(!windows.empty());
    PixelWindow bounds = windows.front();
    for (const PixelWindow& window : windows) {
        const uint32_t right = std::max(bounds.right(), window.right());
        const uint32_t bottom = std::max(bounds.bottom(), window.bottom());
        bounds.x = std::min(bounds.x, window.x);
        bounds.y = std::min(bounds.y, window.y);
        bounds.width = right - bounds.x;
        bounds.height = bottom - bounds.y;
    }
    return bounds;
}

uint64_t pixelsOf(const PixelWindows& windows) {
    uint64_t pixels = 0;
    for (const PixelWindow& window : windows)
        pixels += window.pixels();
    return pixels;
}

std::optional<PixelWindow> overlapOf(const PixelWindows& a, const PixelWindows& b) {
    for (const PixelWindow& x : a)
        for (const PixelWindow& y : b)
            if (const std::optional<PixelWindow> both = overlapOf(x, y))
                return both;
    return std::nullopt;
}

PixelWindows unionOf(const PixelWindows& a, const PixelWindows& b) {
    PixelWindows all = a;
    all.insert(all.end(), b.begin(), b.end());
    const PixelWindow bounds = boundsOf(all);
    if (pixelsOf(all) == bounds.pixels())
        return {bounds};
    std::sort(all.begin(), all.end(),
              [](const PixelWindow& v, const PixelWindow& w) { return v.y != w.y ? v.y < w.y : v.x < w.x; });
    return all;
}

ImagePlace placeOf(const FilmPart& part) {
    const PixelWindow bounds = boundsOf(part.windows);
    return {{bounds.x, bounds.y}, part.whole};
}

} // namespace lavalight
