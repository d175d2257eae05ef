#include "image/texel.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "image/srgb.h"

namespace lavalight {
namespace {

// Linear values of all 8-bit signals, tabulated because a picture has millions of them.
std::array<double, 256> linearValues() {
    std::array<double, 256> values{};
    for (size_t i = 0; i < values.size(); ++i)
        values[i] = decodeSrgb(static_cast<double>(i) / 255.0);
    return values;
}

double channelOf(const Picture& picture, size_t index) {
    if (!picture.is16Bit)
        return picture.bytes[index] / 255.0;
    uint16_t value = 0;
    std::memcpy(&value, &picture.bytes[2 * index], sizeof value);
    return value / 65535.0;
}

} // namespace

glm::dvec4 texelOf(const Picture& picture, uint32_t x, uint32_t y, bool isSrgb) {
    const size_t first = 4 * (size_t{y} * picture.width + x);
    glm::dvec4 value;
    for (glm::length_t c = 0; c < 4; ++c)
        value[c] = channelOf(picture, first + static_cast<size_t>(c));
    static const std::array<double, 256> linear = linearValues();
    if (isSrgb)
        for (glm::length_t c = 0; c < 3; ++c)
            value[c] = picture.is16Bit ? decodeSrgb(value[c])
                                       : linear[picture.bytes[first + static_cast<size_t>(c)]];
    return value;
}

uint32_t wrapTexel(int64_t i, uint32_t size, Wrap wrap) {
    const int64_t n = size;
    if (wrap == Wrap::clamp)
        return static_cast<uint32_t>(std::clamp<int64_t>(i, 0, n - 1));
    const int64_t period = wrap == Wrap::mirror ? 2 * n : n;
    const int64_t inPeriod = (i % period + period) % period;
    return static_cast<uint32_t>(inPeriod < n ? inPeriod : period - 1 - inPeriod);
}

} // namespace lavalight
