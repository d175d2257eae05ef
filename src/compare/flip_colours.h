// The colour spaces of FLIP, and the tone curve by which it shows radiance. Linear means Rec. 709 with white
// at 1, 1, 1.
#pragma once

#include <optional>

#include <glm/glm.hpp>

namespace lavalight {

// Negative values and NaN become 0, infinity the largest that tone curves take without overflow.
[[nodiscard]] glm::vec3 nonNegative(const glm::vec3& radiance);

[[nodiscard]] float luminance(const glm::vec3& linear);

// What a display shows of a pixel, in [0, 1]: the value itself, or radiance times a scale through a tone
// curve.
class DisplayValue {
  public:
    DisplayValue() = default;
    explicit DisplayValue(float scale) : scale_(scale) {}
    [[nodiscard]] glm::vec3 operator()(const glm::vec3& pixel) const;

  private:
    std::optional<float> scale_;
};

// The value that the tone curve of DisplayValue takes to 0.85, where exposures of HDR-FLIP end.
[[nodiscard]] float acesNearlyWhite();

// YCxCz, a linear opponent space, and back.
[[nodiscard]] glm::vec3 opponentFromLinear(const glm::vec3& linear);
[[nodiscard]] glm::vec3 linearFromOpponent(const glm::vec3& opponent);

// L*a*b* whose chroma fades with lightness.
[[nodiscard]] glm::vec3 huntAdjustedLab(const glm::vec3& linear);

// The distance HyAB: city-block between lightness and chroma, so that large differences keep their order.
[[nodiscard]] float colourDifference(const glm::vec3& labA, const glm::vec3& labB);
// The largest distance between colours of the display: that of its green and its blue.
[[nodiscard]] float largestColourDifference();

} // namespace lavalight
