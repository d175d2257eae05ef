#include "compare/heat_colours.h"

#include <algorithm>
#include <array>

#include <glm/glm.hpp>

namespace lavalight {
namespace {

// sRGB signals of the colour map "magma" (Smith and van der Walt 2015, for matplotlib; CC0) at 17 places,
// between which lines stay within 0.01 of it.
constexpr std::array<glm::vec3, 17> kMagma{{
    {0.0015f, 0.0005f, 0.0139f},
    {0.0394f, 0.0309f, 0.1330f},
    {0.1124f, 0.0653f, 0.2756f},
    {0.2104f, 0.0622f, 0.4173f},
    {0.3151f, 0.0712f, 0.4848f},
    {0.4128f, 0.1096f, 0.5045f},
    {0.5105f, 0.1473f, 0.5077f},
    {0.6108f, 0.1809f, 0.4990f},
    {0.7132f, 0.2139f, 0.4762f},
    {0.8135f, 0.2542f, 0.4381f},
    {0.9013f, 0.3165f, 0.3899f},
    {0.9592f, 0.4135f, 0.3599f},
    {0.9859f, 0.5300f, 0.3801f},
    {0.9959f, 0.6477f, 0.4423f},
    {0.9970f, 0.7633f, 0.5296f},
    {0.9928f, 0.8776f, 0.6335f},
    {0.9871f, 0.9914f, 0.7495f},
}};

} // namespace

uint32_t heatColour(float share) {
    constexpr auto kLast = static_cast<float>(kMagma.size() - 1);
    const float place = share > 0.0f ? std::min(share, 1.0f) * kLast : 0.0f;
    const auto before = std::min(static_cast<size_t>(place), kMagma.size() - 2);
    const float rest = place - static_cast<float>(before);
    const glm::uvec3 rgb(glm::mix(kMagma[before], kMagma[before + 1], rest) * 255.0f + 0.5f);
    return rgb.r | rgb.g << 8 | rgb.b << 16 | 0xff000000u;
}

} // namespace lavalight
