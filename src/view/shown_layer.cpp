#include "view/shown_layer.h"

#include <algorithm>

#include "render/settings.h"

namespace lavalight {
namespace {

// Motion leads to the next frame, and a window has none.
std::vector<uint32_t> rowsOfWindows() {
    std::vector<uint32_t> rows = offeredRows();
    std::erase(rows, kMotionPlane);
    return rows;
}

} // namespace

std::vector<ShownLayer> shownLayers() {
    std::vector<ShownLayer> all{ShownLayer{}, kDenoisedColor};
    for (const uint32_t row : rowsOfWindows())
        all.push_back({row, false});
    return all;
}

std::string nameOf(const ShownLayer& shown) {
    return shown.isDenoised ? "denoised" : planeName(shown.row);
}

ShownLayer stepped(const ShownLayer& shown, int steps, bool canDenoise) {
    std::vector<ShownLayer> all = shownLayers();
    if (!canDenoise)
        std::erase(all, kDenoisedColor);
    const auto count = static_cast<int>(all.size());
    const auto at = static_cast<int>(std::find(all.begin(), all.end(), shown) - all.begin());
    const int next = ((at % count + steps) % count + count) % count;
    return all[static_cast<size_t>(next)];
}

uint32_t planesFor(const ShownLayer& shown) {
    if (shown.isDenoised)
        return kDenoisingLayers;
    uint32_t planes = 0;
    if (shown.row != kColorPlane)
        for (const uint32_t row : rowsOfWindows())
            planes |= 1u << row;
    return planes;
}

} // namespace lavalight
