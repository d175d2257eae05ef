#include "compare/flip_colours.h"

#include <algorithm>
#include <cmath>

namespace lavalight {
namespace {

// Linear Rec. 709 to XYZ from the primaries and the white of ITU-R BT.709-6; columns are the primaries.
const glm::mat3 kXyzFromLinear(0.4123908f, 0.2126390f, 0.0193308f, //
                               0.3575843f, 0.7151687f, 0.1191948f, //
                               0.1804808f, 0.0721923f, 0.9505322f);
const glm::mat3 kLinearFromXyz = glm::inverse(kXyzFromLinear);
const glm::vec3 kWhite = kXyzFromLinear * glm::vec3(1.0f);

// ACES as one rational function: the fit of Narkowicz 2015 with its input times 0.6, which makes up for the
// brightness that the fit adds (2021, section 4).
constexpr float kA = 2.51f * 0.6f * 0.6f;
constexpr float kB = 0.03f * 0.6f;
constexpr float kC = 2.43f * 0.6f * 0.6f;
constexpr float kD = 0.59f * 0.6f;
constexpr float kE = 0.14f;
constexpr float kNearlyWhite = 0.85f;

constexpr float kBrightest = 1e9f; // the curve has reached its end; squares are far from the largest float

float acesCurve(float x) {
    return x * (kA * x + kB) / (x * (kC * x + kD) + kE);
}

// The curve of CIE 15: a cube root that goes on as a line near black. The C library's power takes a third of
// the time of its cbrt.
float labCurve(float x) {
    constexpr float kBreak = 6.0f / 29.0f;
    return x > kBreak * kBreak * kBreak ? std::pow(x, 1.0f / 3.0f)
                                        : x / (3.0f * kBreak * kBreak) + 4.0f / 29.0f;
}

} // namespace

glm::vec3 nonNegative(const glm::vec3& radiance) {
    const auto bounded = [](float x) { return x > 0.0f ? std::min(x, kBrightest) : 0.0f; };
    return {bounded(radiance.r), bounded(radiance.g), bounded(radiance.b)};
}

float luminance(const glm::vec3& linear) {
    return 0.2126f * linear.r + 0.7152f * linear.g + 0.0722f * linear.b; // ITU-R BT.709-6
}

glm::vec3 DisplayValue::operator()(const glm::vec3& pixel) const {
    glm::vec3 shown = nonNegative(pixel);
    if (scale_) {
        shown = glm::min(shown * *scale_, kBrightest);
        shown = {acesCurve(shown.r), acesCurve(shown.g), acesCurve(shown.b)};
    }
    return glm::min(shown, 1.0f);
}

float acesNearlyWhite() {
    const float a = kA - kNearlyWhite * kC;
    const float b = kB - kNearlyWhite * kD;
    const float c = -kNearlyWhite * kE;
    return (-b + std::sqrt(b * b - 4.0f * a * c)) / (2.0f * a);
}

glm::vec3 opponentFromLinear(const glm::vec3& linear) {
    const glm::vec3 xyz = kXyzFromLinear * linear / kWhite;
    return {116.0f * xyz.y - 16.0f, 500.0f * (xyz.x - xyz.y), 200.0f * (xyz.y - xyz.z)};
}

glm::vec3 linearFromOpponent(const glm::vec3& opponent) {
    const float y = (opponent.x + 16.0f) / 116.0f;
    const glm::vec3 xyz(y + opponent.y / 500.0f, y, y - opponent.z / 200.0f);
    return kLinearFromXyz * (xyz * kWhite);
}

glm::vec3 huntAdjustedLab(const glm::vec3& linear) {
    const glm::vec3 xyz = kXyzFromLinear * linear / kWhite;
    const float y = labCurve(xyz.y);
    const float lightness = 116.0f * y - 16.0f;
    const float chroma = 0.01f * lightness; // Hunt 1952: colours of the dark look pale
    return {lightness, chroma * 500.0f * (labCurve(xyz.x) - y), chroma * 200.0f * (y - labCurve(xyz.z))};
}

float colourDifference(const glm::vec3& labA, const glm::vec3& labB) {
    const glm::vec3 d = labA - labB;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z); // Abasi et al. 2020
}

float largestColourDifference() {
    return colourDifference(huntAdjustedLab({0.0f, 1.0f, 0.0f}), huntAdjustedLab({0.0f, 0.0f, 1.0f}));
}

} // namespace lavalight
